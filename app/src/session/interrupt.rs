//! Interruption by Ctrl-C, after which work that was done so far is finished.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

/// Flag that Ctrl-C (or a request to end) sets from now on. The second interruption ends the program at once.
pub fn interrupted() -> Arc<AtomicBool> {
    let flag = interruption();
    flag.store(false, Ordering::Relaxed);
    flag
}

/// The same flag with its present value, for work that began before.
pub fn interruption() -> Arc<AtomicBool> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let flag = FLAG.get_or_init(|| {
        let flag = Arc::new(AtomicBool::new(false));
        let set = Arc::clone(&flag);
        // Fails only if there is a handler already, and there is no other than this one.
        let _ = ctrlc::set_handler(move || {
            if set.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        flag
    });
    Arc::clone(flag)
}
