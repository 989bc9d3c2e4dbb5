//! Threads for builds, which end when the worker comes to rest.
//!
//! The allocator gives every thread pages of its own. What one thread allocated and another one freed stays in the first one's
//! pages until that allocates again, which a thread that waits for the next build does not: of a large plant that is gone,
//! megabytes would stay. A thread that ends gives back all that it holds. Starting threads anew takes less than a millisecond,
//! once after each rest.
//!
//! Limits: where the system gives no threads, builds are shared by those that the whole program has.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::thread::JoinHandle;

/// Does something on threads of its own, which share what it does in parallel, and waits until they have ended. They have the
/// priority of the calling thread.
pub(super) fn run<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let Some((pool, threads)) = start() else { return work() };
    let done = pool.install(work);
    drop(pool);
    for thread in threads {
        // One that panicked has been reported by the panic hook.
        let _ = thread.join();
    }
    done
}

fn start() -> Option<(ThreadPool, Vec<JoinHandle<()>>)> {
    let mut threads = Vec::new();
    let spawn = |thread: rayon::ThreadBuilder| {
        let name = format!("build {}", thread.index());
        threads.push(std::thread::Builder::new().name(name).spawn(|| thread.run())?);
        Ok(())
    };
    match ThreadPoolBuilder::new().spawn_handler(spawn).build() {
        Ok(pool) => Some((pool, threads)),
        Err(error) => {
            tracing::debug!("no threads for builds alone: {error}");
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::collections::BTreeSet;

    #[test]
    fn what_is_shared_runs_on_threads_that_end() {
        let names = run(|| {
            let name = |_| std::thread::current().name().map(str::to_owned);
            (0..1000).into_par_iter().filter_map(name).collect::<BTreeSet<String>>()
        });
        assert!(!names.is_empty() && names.iter().all(|name| name.starts_with("build ")), "{names:?}");
        assert_eq!(run(|| (0..1000u64).into_par_iter().sum::<u64>()), 499_500);
    }
}
