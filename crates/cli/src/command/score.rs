//! `looproot bench accuracy --export` and `looproot bench score`

use super::arguments::{AccuracyOptions, ScoreOptions};
use super::bench::{Family, families};
use super::exit::{Exit, Fault};
use super::output::{pool, print};
use looproot::internal::benchmark::published::{
    Answers, Drawn, Problems, header, of_arm, of_platform, of_robot, of_singular_robot, score as scored,
};
use looproot::internal::benchmark::sample::Set;
use looproot::internal::catalogue::robot_names;
use looproot::internal::error::Error;
use looproot::internal::report::score::{bibliography, document, figures, latex, tables, text};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The sets of `--set all`.
const ALL: &str = "general,structured,near-singular,badly-scaled,calibrated,robots,loops,special-loops,platform,\
                   platform-planar-both,platform-near-planar,platform-hexapod,platform-6-3,platform-3-3";
/// Largest file that is read, bytes.
const LARGEST: u64 = 1 << 30;

/// The origin of problems: class, name in the id, and family; or a robot, at any pose or at one of right angles.
enum Source {
    Family(String, &'static str, Family),
    Robot(String),
    SingularRobot(String),
}

fn sources(sets: &str) -> Result<Vec<Source>, Error> {
    let sets = if sets == "all" { ALL } else { sets };
    let mut sources = Vec::new();
    for set in sets.split(',').map(str::trim) {
        if set == "robots" {
            sources.extend(robot_names().into_iter().map(Source::Robot));
        } else if set == "singular-robots" {
            sources.extend(robot_names().into_iter().map(Source::SingularRobot));
        } else {
            let own = families(set)?.into_iter();
            sources.extend(own.map(|(name, family)| Source::Family(set.to_owned(), name, family)));
        }
    }
    Ok(sources)
}

fn drawn(source: &Source, seed: u64, index: u64) -> Result<Option<Drawn>, Error> {
    Ok(match source {
        Source::Robot(name) => of_robot(name, seed, index)?,
        Source::SingularRobot(name) => of_singular_robot(name, seed, index)?,
        Source::Family(class, name, Family::Arms(set)) => {
            let is_chain = matches!(set, Set::Chain(_) | Set::SpecialChain(_));
            let name = if is_chain { format!("{class}-{name}") } else { class.clone() };
            Some(of_arm(class, &name, *set, seed, index)?)
        }
        Source::Family(class, name, Family::Platforms(set)) => Some(of_platform(class, name, *set, seed, index)?),
    })
}

/// Writes problems with their truth.
pub fn export(options: &AccuracyOptions, path: &Path) -> Result<Exit, Fault> {
    let sources = sources(&options.set)?;
    let each = |source: &Source| {
        let draw = |index: u64| drawn(source, options.seed, index);
        (0..options.count).into_par_iter().map(draw).collect::<Result<Vec<_>, Error>>()
    };
    let pool = pool(options.threads)?;
    let all = pool.install(|| sources.par_iter().map(each).collect::<Result<Vec<_>, Error>>())?;
    let (mut lines, mut left_out) = (Vec::new(), BTreeMap::<&str, usize>::new());
    for drawn in all.into_iter().flatten().flatten() {
        match drawn {
            Drawn::Proved(problem) => lines.push(problem.json().to_string()),
            Drawn::LeftOut(code) => *left_out.entry(code).or_default() += 1,
        }
    }
    let head = header(&options.set, options.seed, &lines);
    write(path, &format!("{head}\n{}\n", lines.join("\n")))?;
    let hash = head["hash"].as_str().unwrap_or_default();
    let mut said = format!("{}: {} problems, hash {hash}\n", path.display(), lines.len());
    for (code, count) in left_out {
        said += &format!("  left out, without a proved list of isolated solutions: {count} with the code {code}\n");
    }
    print(&said)?;
    Ok(Exit::Complete)
}

/// Scores a file of answers.
pub fn run(options: &ScoreOptions) -> Result<Exit, Fault> {
    let path = &options.answers;
    let of_answers = |error: Error| located(path, &error);
    let answers = Answers::read(&read(path)?).map_err(of_answers)?;
    let problems = match (&options.problems, &answers.problems) {
        (Some(problems), _) => problems.clone(),
        // The name is relative to the file of answers.
        (None, Some(named)) => path.parent().map_or_else(|| PathBuf::from(named), |folder| folder.join(named)),
        (None, None) => {
            let message = format!("{}: found no `problems` in line 1, expected it or --problems FILE", path.display());
            return Err(Error::Invalid(message).into());
        }
    };
    let problems = Problems::read(&read(&problems)?).map_err(|error| located(&problems, &error))?;
    let found = answers.to(&problems).map_err(of_answers)?;
    let score = scored(&problems.problems, &found);
    for folder in [&options.svg, &options.paper].into_iter().flatten() {
        fs::create_dir_all(folder).map_err(|error| failed(folder, &error))?;
        for (name, figure) in figures(&answers.solver, &score) {
            write(&folder.join(format!("{name}.svg")), &figure)?;
        }
    }
    if let Some(folder) = &options.paper {
        write(&folder.join("table.tex"), &latex(&answers.solver, &answers.hash, &score))?;
        write(&folder.join("looproot.bib"), &bibliography(&answers.hash))?;
        for (name, table) in tables(&score) {
            write(&folder.join(name), &table)?;
        }
    }
    if options.json {
        print(&format!("{}\n", document(&answers.solver, &answers.hash, &score)))?;
    } else {
        print(&text(&answers.solver, &score))?;
    }
    let is_faultless = score.all.lost + score.all.spurious + score.all.duplicates == 0
        && score.all.detected == score.all.self_motions
        && score.all.invented == 0;
    Ok(if is_faultless { Exit::Complete } else { Exit::NotProved })
}

fn read(path: &Path) -> Result<String, Error> {
    let is_large = fs::metadata(path).is_ok_and(|data| data.len() > LARGEST);
    if is_large {
        let message = format!("found more than {LARGEST} bytes");
        return Err(Error::Io { path: path.display().to_string(), message });
    }
    fs::read_to_string(path).map_err(|error| failed(path, &error))
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    fs::write(path, text).map_err(|error| failed(path, &error))
}

fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::Io { path: path.display().to_string(), message: error.to_string() }
}

fn located(path: &Path, error: &Error) -> Error {
    Error::Invalid(format!("{}: {error}", path.display()))
}
