//! `bench accuracy --export` and `bench score`.

use super::{file, json, run};
use serde_json::{Value, json};
use std::fs;

#[test]
fn answers_are_scored() {
    let problems = file("score/problems.jsonl", "");
    let folder = problems.strip_suffix("/problems.jsonl").unwrap();
    let made = run(&["bench", "accuracy", "--set", "general,platform-6-3", "--count", "2", "--export", &problems]);
    assert_eq!(made.code, 0, "{}", made.err);
    assert!(made.out.contains("4 problems, hash "), "{}", made.out);
    let text = fs::read_to_string(&problems).unwrap();
    let mut lines = text.lines().map(json);
    let head = lines.next().unwrap();
    let first = json!({ "format": "looproot-answers", "version": 1, "solver": "test_1", "problems": "problems.jsonl", "hash": head["hash"] });
    let answer = |own: Value| {
        let solutions: Vec<&Value> = own["solutions"].as_array().unwrap().iter().map(|truth| &truth["q"]).collect();
        json!({ "id": own["id"], "solutions": solutions, "seconds": 2e-5 }).to_string()
    };
    let own: Vec<String> = lines.map(answer).collect();
    let answers = file("score/answers.jsonl", format!("{first}\n{}\n", own.join("\n")));
    let figures = format!("{folder}/figures");
    let scored = run(&["bench", "score", &answers, "--paper", &figures]);
    assert_eq!(scored.code, 0, "{}{}", scored.out, scored.err);
    assert!(scored.out.contains("0 lost, 0 spurious, 0 duplicates"), "{}", scored.out);
    let table = fs::read_to_string(format!("{figures}/table.tex")).unwrap();
    assert!(table.contains("platform-6-3 & 2 & ") && table.contains("test\\_1"), "{table}");
    for name in ["position", "rotation", "unknowns", "seconds"] {
        assert!(fs::read_to_string(format!("{figures}/{name}.svg")).unwrap().contains("</svg>"));
    }

    let short = file("score/short.jsonl", format!("{first}\n{}\n", own[1..].join("\n")));
    let scored = run(&["bench", "score", &short, "--json"]);
    let document = json(&scored.out);
    assert_eq!((scored.code, &document["all"]["answered"]), (2, &json!(3)), "{}", scored.out);
    assert!(document["classes"]["general"]["lost"].as_u64().unwrap() > 0);

    for (name, text) in [("empty", String::new()), ("other", text.clone()), ("cut", format!("{first}\n{{"))] {
        let broken = file(&format!("score/{name}.jsonl"), text);
        let said = run(&["bench", "score", &broken]);
        assert!(said.code == 1 && said.err.lines().count() == 1 && said.err.contains("line "), "{name}: {}", said.err);
    }
    let said = run(&["bench", "accuracy", "--set", "general,nothing", "--export", &problems]);
    assert!(said.code == 1 && said.err.contains("`nothing`"), "{}", said.err);
}
