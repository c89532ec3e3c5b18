//! The header is that of the sources, and names every function.

use std::fs;
use std::path::Path;

#[test]
fn the_example_of_the_page_is_the_one_that_is_compiled() {
    let root = &Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let [page, example] =
        ["README.md", "examples/first.c"].map(|name| fs::read_to_string(root.join(name)).expect(name));
    assert!(page.contains(&format!("```c\n{example}```")), "c/README.md shows another example than examples/first.c");
}

#[test]
fn the_header_is_that_of_the_sources() {
    let root = &Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("a configuration");
    let sources = ["answer", "fault", "border"].map(|name| root.join(format!("src/{name}.rs")));
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in sources {
        builder = builder.with_src(source);
    }
    let mut written = Vec::new();
    builder.generate().expect("a header").write(&mut written);
    let written = String::from_utf8(written).expect("text");
    // Rust's heading of what is unsafe says to C what it must promise.
    let written = written.replace("// # Safety\n", "// Promised by the caller:\n").replace('`', "");
    let path = root.join("include/looproot.h");
    if std::env::var_os("LOOPROOT_BLESS").is_some() {
        fs::write(&path, &written).expect("a file");
    }
    let kept = fs::read_to_string(&path).expect("the header");
    assert!(kept == written, "include/looproot.h is not that of src: LOOPROOT_BLESS=1 cargo test -p looproot-c-header");
    let functions = fs::read_to_string(root.join("src/border.rs")).expect("the sources");
    let functions: Vec<&str> =
        functions.split("extern \"C\" fn ").skip(1).filter_map(|rest| rest.split('(').next()).collect();
    assert!(functions.len() >= 20);
    for name in functions {
        assert!(kept.contains(&format!("{name}(")), "the header lacks {name}");
    }
}
