//! The library of mechanisms and the readers of mechanism files.

pub mod ansatz;
pub mod calculus;
mod dh_table;
pub mod displacement;
pub mod entry;
mod file_kind;
mod framework;
pub mod gearing;
mod geometry;
mod heading;
mod job;
mod library;
pub mod lines;
mod linkage;
mod linkage_configuration;
mod linkage_inputs;
pub mod masses;
mod mjcf;
mod mjcf_orientation;
mod motion;
pub mod navigation;
mod node;
mod options;
pub mod planes;
mod platform;
mod platform_limits;
pub mod poses;
mod robot_chain;
mod robot_tip;
mod robot_tree;
mod robots;
mod scope;
mod snap;
mod source;
pub mod space;
mod space_configuration;
pub mod sphere;
mod srdf;
mod synthesis;
mod text;
pub mod tile;
pub mod turn;
mod urdf;

pub use calculus::CalculusFile;
pub use file_kind::FileKind;
pub use framework::FrameworkFile;
pub use heading::Heading;
pub use library::{
    all_names, ansatz_names, builtin, builtin_any, builtin_names, builtin_page, builtin_text, calculus_names, citation,
    moving_names, namesakes,
};
pub(crate) use linkage::root;
pub use linkage::{LinkageCase, LinkageClaim, LinkageClaims, LinkageFile, TraceClaim};
pub use linkage_configuration::LinkageConfiguration;
pub use motion::MotionFile;
pub use options::{Chains, Options};
pub use robots::robot_names;
pub use snap::Snapped;
pub use source::{load, load_ansatz, load_any, load_solvable};
pub use space::{SpaceCase, SpaceClaim, SpaceClaims, SpaceFile};
pub use space_configuration::SpaceConfiguration;
pub use sphere::{SphereCase, SphereClaim, SphereClaims, SphereFile, SphereTrace};
pub use synthesis::{AnglePair, ClaimedDyad, DyadKind, Space, SynthesisFile, Task};
pub use text::{Any, Format, ansatz_from_text, any_from_text, is_ansatz, load_text};
