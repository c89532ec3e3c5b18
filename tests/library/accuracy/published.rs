//! Problems and answers as files, and their score.

use looproot::internal::benchmark::platform::sample::PlatformSet;
use looproot::internal::benchmark::published::{
    ANSWERS, Answers, Body, Drawn, Problem, Problems, Score, header, of_arm, of_platform, of_singular_robot, score,
};
use looproot::internal::benchmark::sample::Set;
use serde_json::{Value, json};

fn problem(drawn: Drawn) -> Problem {
    match drawn {
        Drawn::Proved(problem) => *problem,
        Drawn::LeftOut(code) => panic!("left out: {code}"),
    }
}

/// Two arms, a chain with a translation, one with a spherical joint, and a platform.
fn problems() -> (String, Problems) {
    let own = [
        of_arm("general", "general", Set::General, 1, 0),
        of_arm("near-singular", "near-singular", Set::NearSingular, 1, 2),
        of_arm("loops", "loops-PRRRRR", Set::Chain(18), 1, 0),
        of_arm("loops", "loops-SRRR", Set::Chain(20), 1, 0),
        of_platform("platform", "platform", PlatformSet::General, 1, 0),
    ];
    let lines: Vec<String> = own.into_iter().map(|drawn| problem(drawn.unwrap()).json().to_string()).collect();
    let text = format!("{}\n{}\n", header("test", 1, &lines), lines.join("\n"));
    let read = Problems::read(&text).unwrap();
    (text, read)
}

/// The answers that say what the problems say, changed by a function of the number of the problem and its solutions.
fn answers(problems: &Problems, change: impl Fn(usize, &mut Vec<Vec<f64>>)) -> String {
    let head =
        json!({ "format": ANSWERS, "version": 1, "solver": "test", "problems": "p.jsonl", "hash": problems.hash });
    let line = |(at, problem): (usize, &Problem)| {
        let mut solutions = problem.truth.iter().map(|truth| truth.q.clone()).collect();
        change(at, &mut solutions);
        json!({ "id": problem.id, "solutions": solutions, "certified": true, "seconds": 1e-3 }).to_string()
    };
    let lines: Vec<String> = problems.problems.iter().enumerate().map(line).collect();
    format!("{head}\n{}\n", lines.join("\n"))
}

fn scored(problems: &Problems, change: impl Fn(usize, &mut Vec<Vec<f64>>)) -> Score {
    let answers = Answers::read(&answers(problems, change)).unwrap();
    score(&problems.problems, &answers.to(problems).unwrap())
}

#[test]
fn the_truth_is_found_and_every_fault_is_counted() {
    let (_, problems) = problems();
    let truths: usize = problems.problems.iter().map(|problem| problem.truth.len()).sum();
    let all = scored(&problems, |_, _| ()).all;
    assert_eq!((all.problems, all.answered, all.truths, all.found), (5, 5, truths, truths));
    assert_eq!((all.lost, all.spurious, all.duplicates, all.certified), (0, 0, 0, truths));
    assert!(all.errors.iter().all(|e| e.position < 1e-9 && e.rotation < 1e-9 && e.unknowns == 0.0), "{:?}", all.errors);

    let lost = scored(&problems, |at, q| drop((at == 0).then(|| q.remove(0))));
    assert_eq!((lost.all.lost, lost.all.spurious, lost.lost_in.len()), (1, 0, 1));
    let doubled = scored(&problems, |_, q| q.extend(q.clone()));
    assert_eq!((doubled.all.found, doubled.all.duplicates), (truths, truths));
    for at in 0..5 {
        let off = scored(&problems, |own, q| {
            if own == at {
                q[0][5] += 1e-3;
            }
        });
        assert_eq!((off.all.lost, off.all.spurious), (1, 1), "{}", problems.problems[at].id);
    }
}

#[test]
fn the_same_configuration_in_other_numbers_is_the_same() {
    let (_, problems) = problems();
    let turned = scored(&problems, |at, q| match &problems.problems[at].body {
        Body::Platform { .. } => q.iter_mut().for_each(|q| q[..4].iter_mut().for_each(|x| *x = -*x)),
        Body::Chain { spherical, .. } if !spherical.is_empty() => {
            for q in q {
                q[spherical[0]] -= std::f64::consts::PI;
                q[spherical[0] + 1] *= -1.0;
                q[spherical[0] + 2] += std::f64::consts::PI;
            }
        }
        Body::Chain { .. } => q.iter_mut().for_each(|q| q[5] += std::f64::consts::TAU),
    });
    assert_eq!((turned.all.lost, turned.all.spurious, turned.all.duplicates), (0, 0, 0));
}

#[test]
fn other_files_are_refused_with_the_line() {
    let (text, problems) = problems();
    let changed = text.replacen("\"complex\":16", "\"complex\":15", 1);
    assert!(Problems::read(&changed).unwrap_err().to_string().contains("hash"));
    let own = answers(&problems, |_, _| ());
    let said = |text: &str| {
        let read = Answers::read(text).and_then(|answers| answers.to(&problems).map(drop));
        read.unwrap_err().to_string()
    };
    assert!(said(&own.replacen(&problems.hash, "0123456789abcdef", 1)).contains("line 1"));
    assert!(said(&own.replacen("\"version\":1", "\"version\":2", 1)).contains("version 2"));
    assert!(said(&(own.clone() + "{\"id\": \"other\", \"solutions\": []}\n")).contains("line 7"));
    assert!(said(&(own.clone() + own.lines().nth(1).unwrap())).contains("there once"));
    assert!(said(&own.replacen("\"certified\":true", "\"certified\":[true,1]", 1)).contains("line 2"));
    assert!(said(&(own + "not json\n")).contains("line 7"));
    let short: Value = json!({ "id": problems.problems[0].id, "solutions": [[1.0, 2.0]] });
    let head = answers(&problems, |_, _| ()).lines().next().unwrap().to_owned();
    assert!(said(&format!("{head}\n{short}\n")).contains("6 numbers"));
}

/// A wrist with two axes on one line turns by itself, which an answer tells or not.
#[test]
fn self_motions_are_told_and_set_up_is_timed() {
    let drawn = (0..12).filter_map(|index| of_singular_robot("irb120", 1, index).unwrap());
    let problems: Vec<Problem> = drawn
        .filter_map(|drawn| match drawn {
            Drawn::Proved(problem) => Some(*problem),
            Drawn::LeftOut(_) => None,
        })
        .collect();
    let lines: Vec<String> = problems.iter().map(|problem| problem.json().to_string()).collect();
    let problems = Problems::read(&format!("{}\n{}\n", header("test", 1, &lines), lines.join("\n"))).unwrap();
    let moving = problems.problems.iter().filter(|problem| problem.self_motion > 0).count();
    assert!(moving > 0 && moving < problems.problems.len(), "{moving} of {}", problems.problems.len());
    let scored = |tells: &dyn Fn(&Problem) -> bool| {
        let head = json!({ "format": ANSWERS, "version": 1, "solver": "test", "hash": problems.hash }).to_string();
        let line = |problem: &Problem| {
            let solutions: Vec<&Vec<f64>> = problem.truth.iter().map(|truth| &truth.q).collect();
            let tells = tells(problem);
            json!({ "id": problem.id, "solutions": solutions, "self_motion": tells, "setup_seconds": 2e-3 }).to_string()
        };
        let lines: Vec<String> = std::iter::once(head).chain(problems.problems.iter().map(line)).collect();
        let answers = Answers::read(&lines.join("\n")).unwrap();
        score(&problems.problems, &answers.to(&problems).unwrap())
    };
    let all = problems.problems.len();
    let right = scored(&|problem| problem.self_motion > 0).all;
    assert_eq!([right.complete, right.self_motions, right.detected, right.invented], [all, moving, moving, 0]);
    assert_eq!(right.setup_seconds, vec![2e-3; all]);
    let never = scored(&|_| false).all;
    assert_eq!([never.complete, never.detected, never.invented], [all - moving, 0, 0]);
    let always = scored(&|_| true).all;
    assert_eq!([always.complete, always.detected, always.invented], [moving, moving, all - moving]);
}
