//! Interruption by Ctrl-C, after which the work done so far is completed and kept.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

/// Flag that Ctrl-C (or a request to end) sets from now on. The second interruption ends the program at once.
pub fn interrupted() -> Arc<AtomicBool> {
    let flag = interruption();
    flag.store(false, Ordering::Relaxed);
    flag
}

/// Flag of [`interrupted`] with its present value, for work that began before.
pub fn interruption() -> Arc<AtomicBool> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let flag = FLAG.get_or_init(|| {
        let flag = Arc::new(AtomicBool::new(false));
        let set = Arc::clone(&flag);
        // An error means that there is a handler already, and no other part of the program sets one.
        let _ = ctrlc::set_handler(move || {
            if set.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        flag
    });
    Arc::clone(flag)
}
