//! `looproot bench`

use super::arguments::{AccuracyOptions, BenchOptions, Measure, SpeedOptions};
use super::exit::{Exit, Fault};
use super::output::{pool, print};
use super::solve::stop_on_interrupt;
use indicatif::{ProgressBar, ProgressStyle};
use looproot::assembly::Roots;
use looproot::benchmark::accuracy::{self, Counts, Job, quantiles};
use looproot::benchmark::platform;
use looproot::benchmark::platform::accuracy::PlatformJob;
use looproot::benchmark::platform::sample::PlatformSet;
use looproot::benchmark::sample::{CHAINS, Set};
use looproot::benchmark::speed;
use looproot::error::Error;
use serde_json::json;
use std::sync::atomic::Ordering;

/// Measures accuracy or speed.
pub fn run(options: &BenchOptions) -> Result<Exit, Fault> {
    match &options.measure {
        Measure::Accuracy(options) => measure_accuracy(options),
        Measure::Speed(options) => measure_speed(options),
    }
}

/// A set by its name.
#[derive(Clone, Copy)]
enum Family {
    Arms(Set),
    Platforms(PlatformSet),
}

/// The sets that a name stands for: one, or one for each residual chain.
fn families(name: &str) -> Result<Vec<(&'static str, Family)>, Error> {
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
    let families = families(&options.set)?;
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
            Family::Arms(set) => accuracy::run(Job { set, count, seed, roots }, running, tick),
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
        several => print(&format!("{}\n{foot}", accuracy::table(several)))?,
    }
    let faultless = all.iter().all(|(_, counts)| counts.is_faultless());
    let exit = if faultless { Exit::Complete } else { Exit::NotProved };
    Ok(if running() { exit } else { Exit::Interrupted })
}

fn document(counts: &Counts, set: &str, options: &AccuracyOptions) -> serde_json::Value {
    let spread = |values: &[f64]| {
        let [median, p99, p999, largest] = quantiles(values);
        json!({ "median": median, "p99": p99, "p999": p999, "max": largest })
    };
    let histogram = |map: &std::collections::BTreeMap<usize, usize>| -> serde_json::Value {
        map.iter().map(|(key, count)| (key.to_string(), json!(count))).collect::<serde_json::Map<_, _>>().into()
    };
    json!({
        "set": set, "seed": options.seed, "real_only": options.real,
        counts.noun: counts.solved, "found": counts.found, "lost": counts.lost.len(), "lost_samples": counts.lost,
        "on_self_motion": counts.on_self_motion, "spurious": counts.spurious, "duplicates": counts.duplicates,
        "exactly_counted": counts.counted, "miscounted": counts.miscounted,
        "miscounted_samples": counts.miscounted_in,
        "modes": counts.modes.0, "certified": counts.modes.1,
        "verdicts": counts.verdicts, "reasons": counts.reasons,
        "residual": spread(&counts.residuals), "distance": spread(&counts.errors),
        "real": histogram(&counts.real), "complex": histogram(&counts.complex),
    })
}

fn measure_speed(options: &SpeedOptions) -> Result<Exit, Fault> {
    let (count, repeats, seed) = (options.count, options.repeats.max(1), options.seed);
    let timings = match families(&options.set)?.as_slice() {
        [(_, Family::Arms(Set::General))] => speed::run(count, repeats, seed)?,
        [(_, Family::Platforms(set))] => platform::speed::run(*set, count, repeats, seed)?,
        _ => {
            let message = format!("found the set `{}`, expected general or a set of platforms", options.set);
            return Err(Error::Invalid(message).into());
        }
    };
    print(&format!("{timings}\n"))?;
    Ok(Exit::Complete)
}
