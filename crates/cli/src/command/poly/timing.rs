//! How long something takes, measured as the scripts for the other systems do.

use std::time::Instant;

/// Operations shorter than this, in seconds, are measured by their shortest wall time, longer ones by the median of CPU
/// times: the first is robust against other work on the machine, the second what a long run costs.
const SHORT: f64 = 0.02;
const SHORT_SAMPLES: usize = 300;
const LONG_SAMPLES: usize = 25;

/// The seconds that an operation takes, repeated for the time given but at least done once, and its last result.
pub fn measure<R, E>(budget: f64, mut operation: impl FnMut() -> Result<R, E>) -> Result<(f64, R), E> {
    let begin = Instant::now();
    let (mut shortest, mut cpu) = (f64::INFINITY, Vec::new());
    loop {
        let (start, wall) = (cpu_seconds(), Instant::now());
        let result = operation()?;
        let wall = wall.elapsed().as_secs_f64();
        // Without a CPU clock the wall clock has to do.
        cpu.push(start.zip(cpu_seconds()).map_or(wall, |(start, end)| end - start));
        shortest = wall.min(shortest);
        let limit = if shortest < SHORT { SHORT_SAMPLES } else { LONG_SAMPLES };
        if begin.elapsed().as_secs_f64() > budget || cpu.len() >= limit {
            cpu.sort_by(f64::total_cmp);
            return Ok((if shortest < SHORT { shortest } else { cpu[cpu.len() / 2] }, result));
        }
    }
}

/// CPU time of this thread so far, where the system tells it.
fn cpu_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: u64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds as f64 * 1e-9)
}

/// The most memory that the process has held, in kB, where the system tells it.
pub fn peak_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.split_whitespace().next()?.parse().ok()
}
