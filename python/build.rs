//! Functions of the same machine code are kept once: generic code repeats itself.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // The linker that comes with Rust folds them. It links for this target; elsewhere it may be another one, which does not know the option.
    if std::env::var("TARGET").is_ok_and(|target| target == "x86_64-unknown-linux-gnu") {
        println!("cargo::rustc-link-arg-cdylib=-Wl,--icf=all");
    }
}
