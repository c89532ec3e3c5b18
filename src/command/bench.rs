//! `looproot bench`

use super::arguments::{AccuracyOptions, BenchOptions, Measure, SpeedOptions};
use super::exit::{Exit, Fault};
use super::output::{pool, print};
use super::solve::stop_on_interrupt;
use indicatif::{ProgressBar, ProgressStyle};
use looproot::assembly::Roots;
use looproot::benchmark::accuracy::{self, Counts, Job, quantiles};
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

fn measure_accuracy(options: &AccuracyOptions) -> Result<Exit, Fault> {
    let chains = |set: fn(usize) -> Set| (0..CHAINS.len()).map(|k| (CHAINS[k].0, set(k))).collect::<Vec<_>>();
    let sets = match options.set.as_str() {
        "loops" => chains(Set::Chain),
        "special-loops" => chains(Set::SpecialChain),
        name => Set::NAMED.into_iter().filter(|(known, _)| *known == name).collect(),
    };
    if sets.is_empty() {
        let names = Set::NAMED.map(|(name, _)| name).join(", ");
        let set = &options.set;
        let message = format!("found the set `{set}`, expected one of {names}, loops, special-loops");
        return Err(Error::Invalid(message).into());
    }
    let roots = if options.real { Roots::Real } else { Roots::All };
    let stop = stop_on_interrupt();
    let bar = ProgressBar::new(options.count * sets.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
        bar.set_style(style);
    }
    let running = || !stop.load(Ordering::Relaxed);
    let pool = pool(options.threads)?;
    let mut all = Vec::new();
    for (name, set) in sets {
        let job = Job { set, count: options.count, seed: options.seed, roots };
        all.push((name, pool.install(|| accuracy::run(job, running, || bar.inc(1)))?));
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
        "arms": counts.arms, "found": counts.found, "lost": counts.lost.len(), "lost_samples": counts.lost,
        "on_self_motion": counts.on_self_motion, "spurious": counts.spurious, "duplicates": counts.duplicates,
        "modes": counts.modes.0, "certified": counts.modes.1,
        "verdicts": counts.verdicts, "reasons": counts.reasons,
        "residual": spread(&counts.residuals), "distance": spread(&counts.errors),
        "real": histogram(&counts.real), "complex": histogram(&counts.complex),
    })
}

fn measure_speed(options: &SpeedOptions) -> Result<Exit, Fault> {
    print(&format!("{}\n", speed::run(options.count, options.repeats.max(1), options.seed)?))?;
    Ok(Exit::Complete)
}
