//! Rebuilds the crate when the embedded library of mechanisms changes, which `include_dir` cannot ask for itself.

fn main() {
    println!("cargo::rerun-if-changed=equations");
}
