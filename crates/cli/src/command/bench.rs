//! `looproot bench`

use super::arguments::{AccuracyOptions, BenchOptions, DisturbOptions, Measure, SpeedOptions};
use super::exit::{Exit, Fault};
use super::output::{pool, print};
use super::score;
use super::solve::stop_on_interrupt;
use indicatif::{ProgressBar, ProgressStyle};
use looproot::internal::assembly::Roots;
use looproot::internal::benchmark::accuracy::{self, Counts, Job, quantiles};
use looproot::internal::benchmark::framework;
use looproot::internal::benchmark::mobility as disturbed;
use looproot::internal::benchmark::platform;
use looproot::internal::benchmark::platform::accuracy::PlatformJob;
use looproot::internal::benchmark::platform::sample::PlatformSet;
use looproot::internal::benchmark::sample::{CHAINS, Set};
use looproot::internal::benchmark::speed::{self, StageTimes, Timings};
use looproot::internal::benchmark::speed_loops::{self, ExactRow, LoopRow, LoopTimings, Loops, Spread};
use looproot::internal::catalogue::entry::{Entry, Kind};
use looproot::internal::catalogue::{Any, FrameworkFile, Options, builtin_any, builtin_names, moving_names};
use looproot::internal::error::Error;
use looproot::internal::mobility::{Linkage, moves};
use looproot::internal::report::number::duration;
use looproot::internal::report::table::Columns;
use rug::Rational;
use serde_json::json;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Measures accuracy or speed.
pub fn run(options: &BenchOptions) -> Result<Exit, Fault> {
    match &options.measure {
        Measure::Accuracy(options) => measure_accuracy(options),
        Measure::Mobility(options) => measure_mobility(options),
        Measure::Score(options) => score::run(options),
        Measure::Speed(options) => measure_speed(options),
    }
}

/// A set of samples.
#[derive(Clone, Copy)]
pub(super) enum Family {
    Arms(Set),
    Platforms(PlatformSet),
}

/// Returns the sets with this name: one, or one for each residual chain.
pub(super) fn families(name: &str) -> Result<Vec<(&'static str, Family)>, Error> {
    let chains = |set: fn(usize) -> Set| (0..CHAINS.len()).map(|k| (CHAINS[k].0, Family::Arms(set(k)))).collect();
    match name {
        "loops" => return Ok(chains(Set::Chain)),
        "special-loops" => return Ok(chains(Set::SpecialChain)),
        _ => {}
    }
    let arms = Set::NAMED.into_iter().map(|(name, set)| (name, Family::Arms(set)));
    let platforms = PlatformSet::NAMED.into_iter().map(|(name, set)| (name, Family::Platforms(set)));
    let mut all = arms.chain(platforms);
    let names = all.clone().map(|(name, _)| name).collect::<Vec<_>>().join(", ");
    let found = all.find(|(known, _)| *known == name).map(|found| vec![found]);
    found
        .ok_or_else(|| Error::Invalid(format!("found the set `{name}`, expected one of {names}, loops, special-loops")))
}

fn measure_accuracy(options: &AccuracyOptions) -> Result<Exit, Fault> {
    if let Some(path) = &options.export {
        return score::export(options, path);
    }
    let families = families(&options.set)?;
    let is_loop = |(_, family): &(_, Family)| matches!(family, Family::Arms(Set::Chain(_) | Set::SpecialChain(_)));
    if options.exact && !families.iter().all(is_loop) {
        let message = format!("found --exact with the set `{}`, expected it with loops or special-loops", options.set);
        return Err(Error::Invalid(message).into());
    }
    let exact = options.exact;
    let roots = if options.real { Roots::Real } else { Roots::All };
    let (count, seed) = (options.count, options.seed);
    let stop = stop_on_interrupt();
    let bar = ProgressBar::new(count * families.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
        bar.set_style(style);
    }
    let running = || !stop.load(Ordering::Relaxed);
    let tick = || bar.inc(1);
    let pool = pool(options.threads)?;
    let mut all = Vec::new();
    for (name, family) in families {
        let counts = pool.install(|| match family {
            Family::Arms(set) => accuracy::run(Job { set, count, seed, roots, exact }, running, tick),
            Family::Platforms(set) => platform::accuracy::run(PlatformJob { set, count, seed, roots }, running, tick),
        })?;
        all.push((name, counts));
    }
    bar.finish_and_clear();
    let what = if options.real { "real solutions only" } else { "all solutions" };
    let foot = format!("  set {}, seed {}, {what}\n", options.set, options.seed);
    match all.as_slice() {
        [(name, counts)] if options.json => print(&format!("{}\n", document(counts, name, options)))?,
        [(_, counts)] => print(&format!("{counts}\n{foot}"))?,
        several if options.json => {
            let documents: Vec<_> = several.iter().map(|(name, counts)| document(counts, name, options)).collect();
            print(&format!("{}\n", serde_json::Value::from(documents)))?;
        }
        several if exact => {
            let foot = format!("{foot}  data of three decimals\n");
            print(&format!("{}\n{}\n{foot}", accuracy::table(several), exact_table(several)))?;
        }
        several => print(&format!("{}\n{foot}", accuracy::table(several)))?,
    }
    let faultless = all.iter().all(|(_, counts)| counts.is_faultless());
    let exit = if faultless { Exit::Complete } else { Exit::NotProved };
    Ok(if running() { exit } else { Exit::Interrupted })
}

/// Compares closure polynomials with solutions: one line per family, then the differences.
fn exact_table(rows: &[(&str, Counts)]) -> String {
    let header = ["chain", "polynomials", "solutions", "values", "differ", "neither", "mod p", "mean ms", "longest ms"];
    let mut table = Columns::new(&header, &["chain"]);
    let mut notes = String::new();
    for (name, counts) in rows {
        let Some(exact) = &counts.exact else { continue };
        let neither = exact.not_comparable.values().sum::<usize>();
        let counted = [exact.count(), exact.solutions, exact.values, exact.differ.len(), neither, exact.unproved];
        let times = [exact.time / exact.count().max(1) as f64, exact.longest].map(|time| format!("{:.2}", 1e3 * time));
        table.row(std::iter::once((*name).to_owned()).chain(counted.map(|n| n.to_string())).chain(times));
        for (reason, count) in &exact.not_comparable {
            notes += &format!("  {name}: {count} with neither, {reason}\n");
        }
        for (index, how) in &exact.differ {
            notes += &format!("  {name}, sample {index} differs: {how}\n");
        }
    }
    let legend = "exact closure polynomials beside the solutions. solutions: simple roots, as many as solutions, and as many real ones;\n\
                  values: shared or multiple roots, as many distinct ones as the solutions have values, and as many real ones\n";
    legend.to_owned() + &table.text() + &notes
}

fn document(counts: &Counts, set: &str, options: &AccuracyOptions) -> serde_json::Value {
    let spread = |values: &[f64]| {
        let [median, p99, p999, largest] = quantiles(values);
        json!({ "median": median, "p99": p99, "p999": p999, "max": largest })
    };
    let histogram = |map: &std::collections::BTreeMap<usize, usize>| -> serde_json::Value {
        map.iter().map(|(key, count)| (key.to_string(), json!(count))).collect::<serde_json::Map<_, _>>().into()
    };
    let exact = counts.exact.as_ref().map(|exact| {
        let differ = exact.differ.iter().map(|(index, how)| json!({ "sample": index, "how": how }));
        json!({
            "polynomials": exact.count(), "solutions": exact.solutions, "values": exact.values,
            "differ": differ.collect::<Vec<_>>(), "not_comparable": exact.not_comparable, "modulo_a_prime": exact.unproved,
            "mean_ms": 1e3 * exact.time / exact.count().max(1) as f64, "longest_ms": 1e3 * exact.longest,
        })
    });
    json!({
        "set": set, "seed": options.seed, "real_only": options.real,
        counts.noun: counts.solved, "found": counts.found, "lost": counts.lost.len(), "lost_samples": counts.lost,
        "on_self_motion": counts.on_self_motion, "spurious": counts.spurious, "duplicates": counts.duplicates,
        "exactly_counted": counts.counted, "miscounted": counts.miscounted,
        "miscounted_samples": counts.miscounted_in,
        "modes": counts.modes.0, "certified": counts.modes.1,
        "verdicts": counts.verdicts, "proofs": counts.proofs, "reasons": counts.reasons,
        "residual": spread(&counts.residuals), "distance": spread(&counts.errors),
        "real": histogram(&counts.real), "complex": histogram(&counts.complex),
        "exact": exact,
    })
}

/// A mechanism that moves, to be disturbed.
enum Mobile {
    Loop(Box<Entry>),
    Framework(Box<FrameworkFile>),
}

/// Returns the requested mobile loops of up to six variables and mobile frameworks.
fn mobile(options: &DisturbOptions) -> Result<Vec<(String, Mobile)>, Error> {
    let names = options.entry.as_ref().map_or_else(
        || {
            [builtin_names(), moving_names().into_iter().filter(|name| name.starts_with("framework/")).collect()]
                .concat()
        },
        |name| vec![name.clone()],
    );
    let mut found = Vec::new();
    for name in names {
        match builtin_any(&name, &Options::default())? {
            Any::Entry(entry) if entry.kind() == Kind::Loop => {
                let linkage = entry.chain().and_then(|chain| Linkage::of(chain).ok());
                let is_mobile =
                    |linkage: &Linkage<Rational>| linkage.variables.len() <= 6 && moves(linkage) == Some(true);
                if linkage.as_ref().is_some_and(is_mobile) {
                    found.push((name, Mobile::Loop(entry)));
                }
            }
            Any::Framework(file) if file.dimension != Some(0) => found.push((name, Mobile::Framework(file))),
            _ => {}
        }
    }
    if found.is_empty() {
        let message = "found no mobile loop of up to six variables and no mobile framework, expected one";
        return Err(Error::Invalid(message.to_owned()));
    }
    Ok(found)
}

fn measure_mobility(options: &DisturbOptions) -> Result<Exit, Fault> {
    let pool = pool(options.threads)?;
    let mobile = mobile(options)?;
    let (count, seed) = (options.count, options.seed);
    let solved = options.solve.unwrap_or(count);
    let stop = stop_on_interrupt();
    let bar = ProgressBar::new(count * mobile.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta} {msg}") {
        bar.set_style(style);
    }
    let running = || !stop.load(Ordering::Relaxed);
    let tick = || bar.inc(1);
    let header = [
        "mechanism",
        "disturbed",
        "immobile",
        "undecided",
        "mobile",
        "asked",
        "solved",
        "counted",
        "miscounted",
        "complex",
        "real",
        "each",
    ];
    let mut table = Columns::new(&header, &["mechanism"]);
    let mut documents = Vec::new();
    let mut is_faultless = true;
    for (name, mechanism) in mobile.iter().take_while(|_| running()) {
        bar.set_message(name.clone());
        let start = Instant::now();
        let tally = pool.install(|| match mechanism {
            Mobile::Loop(entry) => disturbed::run(entry, (count, solved), seed, running, tick),
            Mobile::Framework(file) => framework::run(file, count, seed, running, tick),
        });
        let each = start.elapsed().as_secs_f64() * 1e6 / tally.count.max(1) as f64;
        is_faultless &= tally.mobile.is_empty() && tally.miscounted.is_empty();
        let (complex, real) = tally.configurations;
        let decided = [tally.count, tally.immobile, tally.undecided, tally.mobile.len()].map(|n| n.to_string());
        let counted = [tally.asked, tally.solved, tally.counted, tally.miscounted.len(), complex, real];
        let counted =
            counted.map(|n| if matches!(mechanism, Mobile::Loop(_)) { n.to_string() } else { "-".to_owned() });
        table.row(std::iter::once(name.clone()).chain(decided).chain(counted).chain([duration(each)]));
        documents.push(json!({
            "mechanism": name, "disturbed": tally.count, "immobile": tally.immobile, "undecided": tally.undecided,
            "mobile": tally.mobile, "asked": tally.asked, "solved": tally.solved, "counted": tally.counted, "miscounted": tally.miscounted,
            "complex": complex, "real": real,
        }));
    }
    bar.finish_and_clear();
    let foot = format!(
        "errors of 1e-3 to 1e-9 in one link of a loop, in all vertices or all lengths of a framework, seed {seed}\n\
         asked: loops given to `solve`; solved: those whose list of configurations it calls complete; counted: those that an exact count confirms\n"
    );
    print(&if options.json { format!("{}\n", json!(documents)) } else { table.text() + &foot })?;
    let exit = if is_faultless { Exit::Complete } else { Exit::NotProved };
    Ok(if running() { exit } else { Exit::Interrupted })
}

fn measure_speed(options: &SpeedOptions) -> Result<Exit, Fault> {
    let of = |count, repeats| (options.count.unwrap_or(count), options.repeats.unwrap_or(repeats).max(1), options.seed);
    let loops = match options.set.as_str() {
        "loops" => Some(Loops::General),
        "special-loops" => Some(Loops::Special),
        "robots" => Some(Loops::Robots),
        _ => None,
    };
    let written = if let Some(loops) = loops {
        let (count, repeats, seed) = of(20, if loops == Loops::Robots { 3 } else { 11 });
        let timings = speed_loops::run(loops, count, repeats, seed)?;
        if options.json { format!("{}\n", loops_document(&timings)) } else { loops_table(&timings) }
    } else {
        let (count, repeats, seed) = of(200, 101);
        let timings = match families(&options.set)?.as_slice() {
            [(_, Family::Arms(Set::General))] => speed::run(count, repeats, seed)?,
            [(_, Family::Platforms(set))] => platform::speed::run(*set, count, repeats, seed)?,
            _ => {
                let message = format!(
                    "found the set `{}`, expected general, robots, loops, special-loops or a set of platforms",
                    options.set
                );
                return Err(Error::Invalid(message).into());
            }
        };
        if options.json { format!("{}\n", stages_document(&timings)) } else { format!("{timings}\n") }
    };
    print(&written)?;
    Ok(Exit::Complete)
}

fn stages_document(timings: &Timings) -> serde_json::Value {
    let row = |StageTimes { name, median, mean, least }: &StageTimes| json!({ "name": name, "median_us": median, "mean_us": mean, "least_us": least });
    json!({ "stages": timings.rows.iter().map(row).collect::<Vec<_>>() })
}

/// Returns three numbers of a spread: median, 99 % quantile, slowest.
fn cells(spread: Option<&Spread>) -> [String; 3] {
    spread.map_or_else(Default::default, |s| [s.median, s.nearly_all, s.slowest].map(|time| format!("{time:.1}")))
}

fn loops_table(timings: &LoopTimings) -> String {
    const THREE: [&str; 3] = ["median", "99 %", "slowest"];
    let header = |what: &[&str]| -> Vec<String> {
        what.iter().flat_map(|what| THREE.map(|of| format!("{what} {of}").trim().to_owned())).collect()
    };
    let loops = ["unknowns".to_owned(), "solutions".to_owned()].into_iter().chain(header(&["real", "all", "answer"]));
    let mut table = Columns::new(&loops.collect::<Vec<_>>(), &["unknowns"]);
    for row in &timings.loops {
        let spreads = [row.real.as_ref(), row.all.as_ref(), Some(&row.answer)];
        let own = [row.name.clone(), row.solutions.to_string()];
        table.row(own.into_iter().chain(spreads.into_iter().flat_map(cells)));
    }
    let exact = ["unknowns".to_owned(), "degree".to_owned()].into_iter().chain(header(&["derived", "roots"]));
    let mut polynomials = Columns::new(&exact.collect::<Vec<_>>(), &["unknowns"]);
    for row in &timings.exact {
        let own = [row.name.to_owned(), row.degree.to_string()];
        polynomials.row(own.into_iter().chain([&row.derived, &row.isolated].into_iter().flat_map(|s| cells(Some(s)))));
    }
    let Spread { median, least, .. } = timings.reference;
    let exact = if timings.exact.is_empty() {
        String::new()
    } else {
        format!(
            "\nexact, lengths and half-angle tangents of three decimals. derived: from data to polynomial and isolated real roots.\n\
             roots: of this their isolation, and their number by Sturm's theorem\n{}",
            polynomials.text()
        )
    };
    format!(
        "microseconds, one core; faer, eigenvalues of one 16x16 matrix: median {median:.1}, least {least:.1}\n\n\
         f64, prepared once, many inputs. real, all: the numbers and the proof of each mode.\n\
         answer: as `solve` gives it, from the exact input to all real solutions and the proof that there are no others\n{}{exact}",
        table.text()
    )
}

fn loops_document(timings: &LoopTimings) -> serde_json::Value {
    let spread = |s: &Spread| {
        json!({
            "median_us": s.median, "least_us": s.least, "nearly_all_us": s.nearly_all, "slowest_us": s.slowest,
        })
    };
    let row = |row: &LoopRow| {
        json!({
            "unknowns": row.name, "solutions": row.solutions, "real": row.real.as_ref().map(spread),
            "all": row.all.as_ref().map(spread), "answer": spread(&row.answer),
            "slowest": { "sample": row.slowest.0, "input": row.slowest.1 },
        })
    };
    let exact = |row: &ExactRow| {
        json!({
            "unknowns": row.name, "degree": row.degree, "derived": spread(&row.derived),
            "roots": spread(&row.isolated),
        })
    };
    json!({
        "faer_16x16": spread(&timings.reference),
        "loops": timings.loops.iter().map(row).collect::<Vec<_>>(),
        "exact": timings.exact.iter().map(exact).collect::<Vec<_>>(),
    })
}
