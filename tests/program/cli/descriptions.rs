//! Robot descriptions: the names of their joints, and chains that are too long.

use super::{file, json, run};

/// A chain of revolutes, as a robot description.
fn robot(joints: usize) -> String {
    let links: Vec<String> = (0..=joints).map(|k| format!("<link name=\"l{k}\"/>")).collect();
    let links = links.concat();
    let joint = |k: usize| {
        format!(
            "<joint name=\"turn{k}\" type=\"revolute\"><parent link=\"l{}\"/><child link=\"l{k}\"/>\
             <origin xyz=\"0.1 0.2 0.3\" rpy=\"0.3 {} 0.7\"/><axis xyz=\"0 0 1\"/><limit lower=\"-3\" upper=\"3\"/></joint>",
            k - 1,
            k % 5
        )
    };
    format!("<robot name=\"arm\">{links}{}</robot>", (1..=joints).map(joint).collect::<String>())
}

#[test]
fn a_long_chain_is_refused_before_its_axes_are_computed() {
    let path = file("long.urdf", robot(3000));
    let start = std::time::Instant::now();
    let long = run(&["show", &path]);
    assert_eq!(long.code, 1);
    assert!(long.err.contains("found 3000 joints with 3000 variables"), "{}", long.err);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

#[test]
fn documents_name_the_joints_of_a_robot_description() {
    let path = file("robot.urdf", robot(6));
    let joints = "0.1, 0.2, 0.3, 0.4, 0.5, 0.6";
    let document = json(&run(&["solve", &path, "--joints", joints, "--json", "--seed", "7"]).out);
    let labels: Vec<&str> =
        document["joint_variables"].as_array().unwrap().iter().map(|own| own["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["turn1", "turn2", "turn3", "turn4", "turn5", "turn6"]);
    assert_eq!((&document["base_link"], &document["tip_link"]), (&"l0".into(), &"l6".into()));
    assert_eq!(document["name"], "robot");
    assert_eq!(document["units"]["angle"], "rad");
    assert!(document["mechanism"] == json(&run(&["show", &path, "--json"]).out));
    let result = &document["results"][0];
    assert_eq!(result["asked"]["matrix"].as_array().unwrap().len(), 4);
    let ids: Vec<u64> = result["modes"].as_array().unwrap().iter().map(|mode| mode["id"].as_u64().unwrap()).collect();
    assert!(ids.iter().copied().eq(1..=ids.len() as u64) && !ids.is_empty());
}
