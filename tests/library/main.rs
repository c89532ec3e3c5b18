//! The tests of the library, one program in all: what links once is tested soonest.

mod accuracy;
mod allocation;
mod arms;
mod bennett_dyads;
mod certificate;
mod chains;
mod entries;
mod exact;
mod examples;
mod families;
mod files;
mod golden;
mod house;
mod laws;
mod linkage_derive;
mod linkage_sweep;
mod metamorphic;
mod mutations;
mod pencil;
mod platform;
mod printed;
mod real_field;
mod strategies;
mod sweep_proof;
mod synthesis;
