//! Says at which level the program is optimised, as limits of time in its tests depend on it, and links it to a fixed address.

use std::env::var;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-env=OPT_LEVEL={}", var("OPT_LEVEL").unwrap_or_default());
    // Some 30,000 addresses in its tables need not be set at every start then, which took a third of the time of `--version`.
    let target = ["OS", "ENV"].map(|part| var(format!("CARGO_CFG_TARGET_{part}")).unwrap_or_default());
    if target == ["linux", "gnu"] {
        println!("cargo::rustc-link-arg-bins=-no-pie");
    }
}
