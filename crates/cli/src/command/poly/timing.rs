//! Timings, measured as in the scripts for the other systems.

use std::time::Instant;

/// Operations shorter than this, in seconds, are measured by their shortest wall time, longer ones by the median of CPU
/// times. The first is robust against other work on the machine, the second shows the cost of a long run.
const SHORT: f64 = 0.02;
const SHORT_SAMPLES: usize = 300;
const LONG_SAMPLES: usize = 25;

/// Returns the seconds of an operation, repeated for the given time but at least once, and its last result.
pub fn measure<R, E>(budget: f64, mut operation: impl FnMut() -> Result<R, E>) -> Result<(f64, R), E> {
    let begin = Instant::now();
    let (mut shortest, mut cpu) = (f64::INFINITY, Vec::new());
    loop {
        let (start, wall) = (cpu_seconds(), Instant::now());
        let result = operation()?;
        let wall = wall.elapsed().as_secs_f64();
        // Without a CPU clock the wall clock is used.
        cpu.push(start.zip(cpu_seconds()).map_or(wall, |(start, end)| end - start));
        shortest = wall.min(shortest);
        let limit = if shortest < SHORT { SHORT_SAMPLES } else { LONG_SAMPLES };
        if begin.elapsed().as_secs_f64() > budget || cpu.len() >= limit {
            cpu.sort_by(f64::total_cmp);
            return Ok((if shortest < SHORT { shortest } else { cpu[cpu.len() / 2] }, result));
        }
    }
}

/// Returns the CPU time of this thread so far, if the system reports it.
fn cpu_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: u64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds as f64 * 1e-9)
}

/// Returns the peak memory of the process in kB, if the system reports it.
pub fn peak_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.split_whitespace().next()?.parse().ok()
}
