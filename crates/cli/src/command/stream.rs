//! Runs jobs on several threads and takes their results in order: threads share the work without barriers, and few results wait.

use rayon::ThreadPool;
use std::collections::BTreeMap;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Maximum number of jobs that a thread takes at a time: a result has some kilobytes.
const BATCH: usize = 128;
/// A batch that takes less time than this is followed by a larger one, one of four times as much by a smaller one: waking the thread
/// that takes the results costs some 10 us.
const SHORT: Duration = Duration::from_micros(250);
/// The first batches are smaller, so that few jobs are shared evenly.
const GROWTH: usize = 8;
/// Number of batches per thread begun ahead of the last one taken: one slow pose does not stop the others, and memory use
/// stays bounded.
const AHEAD: usize = 32;

/// The data that the threads share: the remaining jobs, and the number of results taken.
struct Shared<I> {
    jobs: I,
    taken: usize,
    begun: usize,
    reported: usize,
    /// Whether no more batches are begun.
    is_closed: bool,
}

/// A batch of jobs with their results, and its number.
type Batch<J, R> = (usize, Vec<(J, R)>);

/// Does all jobs on a pool, each by `work` with the memory of its thread, and passes the results to `take` in order, batch by
/// batch. `take` returns whether to go on.
///
/// # Errors
/// The first error of `take`, after which no more jobs are begun.
pub fn ordered<J: Send, R: Send, M, E: Send>(
    pool: &ThreadPool,
    jobs: impl Iterator<Item = J> + Send,
    memory: impl Fn() -> M + Sync,
    work: impl Fn(&mut M, &J) -> R + Sync,
    mut take: impl FnMut(Vec<(J, R)>) -> Result<bool, E>,
) -> Result<(), E> {
    // One thread passes results to another one; a single thread, as in a browser, would wait for itself.
    if cfg!(target_family = "wasm") {
        return alone(jobs, memory, work, take);
    }
    let threads = pool.current_num_threads();
    let shared = Mutex::new(Shared { jobs, taken: 0, begun: 0, reported: 0, is_closed: false });
    let moved = Condvar::new();
    let (sender, receiver) = channel::<Batch<J, R>>();
    pool.in_place_scope(|scope| {
        for _ in 0..threads {
            let (shared, moved, memory, work, sender) = (&shared, &moved, &memory, &work, sender.clone());
            scope.spawn(move |_| {
                let mut memory = memory();
                run(shared, moved, threads, &sender, |job| work(&mut memory, job));
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut next = 0;
        let mut answer = Ok(());
        'all: for (number, batch) in receiver {
            waiting.insert(number, batch);
            while let Some(batch) = waiting.remove(&next) {
                next += 1;
                match take(batch) {
                    Ok(true) => {}
                    Ok(false) => break 'all,
                    Err(error) => {
                        answer = Err(error);
                        break 'all;
                    }
                }
                shared.lock().unwrap_or_else(PoisonError::into_inner).reported = next;
                moved.notify_all();
            }
        }
        shared.lock().unwrap_or_else(PoisonError::into_inner).is_closed = true;
        moved.notify_all();
        answer
    })
}

/// As [`ordered`] on this thread alone, job by job.
fn alone<J, R, M, E>(
    jobs: impl Iterator<Item = J>,
    memory: impl Fn() -> M,
    work: impl Fn(&mut M, &J) -> R,
    mut take: impl FnMut(Vec<(J, R)>) -> Result<bool, E>,
) -> Result<(), E> {
    let mut memory = memory();
    for job in jobs {
        let result = work(&mut memory, &job);
        if !take(vec![(job, result)])? {
            return Ok(());
        }
    }
    Ok(())
}

/// Takes batches on one thread until there are no more.
fn run<J, R>(
    shared: &Mutex<Shared<impl Iterator<Item = J>>>,
    moved: &Condvar,
    threads: usize,
    sender: &Sender<Batch<J, R>>,
    mut work: impl FnMut(&J) -> R,
) {
    let mut fitting = 1;
    loop {
        let lock = shared.lock().unwrap_or_else(PoisonError::into_inner);
        let is_ahead = |own: &mut Shared<_>| !own.is_closed && own.begun >= own.reported + AHEAD * threads;
        let mut own = moved.wait_while(lock, is_ahead).unwrap_or_else(PoisonError::into_inner);
        if own.is_closed {
            return;
        }
        let size = fitting.min(1 + own.taken / (GROWTH * threads));
        let jobs: Vec<J> = own.jobs.by_ref().take(size).collect();
        if jobs.is_empty() {
            return;
        }
        let number = own.begun;
        own.begun += 1;
        own.taken += jobs.len();
        drop(own);
        let start = Instant::now();
        let done = jobs.into_iter().map(|job| {
            let result = work(&job);
            (job, result)
        });
        let done = done.collect();
        if start.elapsed() < SHORT {
            fitting = BATCH.min(2 * fitting);
        } else if start.elapsed() > 4 * SHORT {
            fitting = fitting.div_ceil(2);
        }
        if sender.send((number, done)).is_err() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::ThreadPoolBuilder;

    #[test]
    fn results_are_taken_in_the_order_of_the_jobs() {
        for threads in [1, 3] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut taken = Vec::new();
            let work = |count: &mut usize, job: &usize| {
                *count += 1;
                if job.is_multiple_of(97) {
                    std::thread::sleep(std::time::Duration::from_millis(1));
                }
                job * job
            };
            let take = |batch: Vec<(usize, usize)>| -> Result<bool, ()> {
                taken.extend(batch);
                Ok(true)
            };
            ordered(&pool, 0..10_000, || 0, work, take).unwrap();
            assert!(taken.into_iter().eq((0..10_000).map(|k| (k, k * k))));
        }
    }

    #[test]
    fn one_thread_alone_does_the_same() {
        let mut found = Vec::new();
        let take = |batch: Vec<(i32, i32)>| -> Result<bool, ()> {
            found.extend(batch);
            Ok(found.len() < 5)
        };
        alone(0..10, || 0, |sum: &mut i32, job: &i32| (*sum += job, *sum).1, take).unwrap();
        assert_eq!(found, [(0, 0), (1, 1), (2, 3), (3, 6), (4, 10)]);
        assert_eq!(alone(0..10, || (), |(), job: &i32| *job, |_| Err("full")), Err("full"));
    }

    #[test]
    fn an_error_ends_the_work() {
        let pool = ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let mut taken = 0;
        let take = |batch: Vec<(usize, ())>| {
            taken += batch.len();
            if taken > 100 { Err(taken) } else { Ok(true) }
        };
        assert!(ordered(&pool, 0.., || (), |(), _| (), take).is_err());
    }
}
