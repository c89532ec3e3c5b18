//! Timings, measured as in the scripts for the other systems.

use std::time::Instant;

/// Operations shorter than this, in seconds, are measured by their shortest time, longer ones by the median of CPU times.
/// The first is robust against other work on the machine, the second shows the cost of a long run.
const SHORT: f64 = 0.02;
const SHORT_SAMPLES: usize = 300;
const LONG_SAMPLES: usize = 25;
/// Operations shorter than this, in seconds, are repeated until they take about as long together: what the clocks take would be seen otherwise.
const TOGETHER: f64 = 1e-4;

/// Returns the seconds of an operation, repeated for the given time but at least once, and its last result.
///
/// CPU times are those of all threads. A short operation is counted by the longer of wall and CPU time: the CPU clock of
/// some machines is coarse, and on several threads the wall clock shows too little.
pub fn measure<R, E>(budget: f64, mut operation: impl FnMut() -> Result<R, E>) -> Result<(f64, R), E> {
    let begin = Instant::now();
    let (mut shortest, mut cpu) = (f64::INFINITY, Vec::new());
    loop {
        // As many as took that time when they were fastest.
        let count = std::iter::successors(Some(1_u32), |count| count.checked_mul(2))
            .find(|count| f64::from(*count) * shortest >= TOGETHER)
            .unwrap_or(1);
        let (start, wall) = (cpu_seconds(), Instant::now());
        for _ in 1..count {
            operation()?;
        }
        let result = operation()?;
        let wall = wall.elapsed().as_secs_f64() / f64::from(count);
        // Without a CPU clock the wall clock is used.
        let spent = start.zip(cpu_seconds()).map_or(wall, |(start, end)| (end - start) / f64::from(count));
        shortest = shortest.min(if wall < SHORT { wall.max(spent) } else { spent });
        cpu.push(spent);
        let limit = if shortest < SHORT { SHORT_SAMPLES } else { LONG_SAMPLES };
        if begin.elapsed().as_secs_f64() > budget || cpu.len() >= limit {
            cpu.sort_by(f64::total_cmp);
            return Ok((if shortest < SHORT { shortest } else { cpu[cpu.len() / 2] }, result));
        }
    }
}

/// Returns the CPU time of all threads of the process so far, if the system reports it. Threads of a pool stay, so
/// that nothing that they did is lost.
fn cpu_seconds() -> Option<f64> {
    let thread = |path: std::path::PathBuf| -> Option<u64> {
        std::fs::read_to_string(path.join("schedstat")).ok()?.split_whitespace().next()?.parse().ok()
    };
    let threads = std::fs::read_dir("/proc/self/task").ok()?;
    let nanoseconds: u64 = threads.map(|entry| thread(entry.ok()?.path())).sum::<Option<u64>>()?;
    Some(nanoseconds as f64 * 1e-9)
}

/// Returns the peak memory of the process in kB, if the system reports it.
pub fn peak_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.split_whitespace().next()?.parse().ok()
}
