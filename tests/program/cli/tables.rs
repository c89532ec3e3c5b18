//! Tables of assemblies: which columns they have.

use super::run;

#[test]
fn a_table_of_a_linkage_has_a_column_for_multiplicities_where_one_is_not_simple() {
    let header = |out: &str| out.lines().find(|line| line.trim_start().starts_with("mode ")).unwrap().to_owned();
    let four = run(&["solve", "linkage/fourfold_assembly"]).out;
    assert!(header(&four).contains("multiplicity"), "{four}");
    assert!(four.lines().any(|line| line.starts_with(" 1 ") && line.trim_end().ends_with(" 4")), "{four}");
    let simple = run(&["solve", "linkage/eight_bar_16"]).out;
    assert!(!header(&simple).contains("multiplicity"), "{simple}");
}
