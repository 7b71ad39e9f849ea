//! Waiter: the thread that asks one window for its next texture.
//!
//! A surface may keep its caller for a refresh of its monitor, and up to a second where its window is hidden. Each
//! window is therefore asked by a thread of its own: waits for several monitors pass side by side, and the ride and
//! the keys never stop for a window that does not answer.

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded};
use std::io;
use std::thread::{Builder, JoinHandle};
use std::time::Instant;

/// Thread that answers one question at a time.
#[derive(Debug)]
pub struct TextureWaiter<Q, A> {
    /// Questions; `None` once the thread is to end.
    questions: Option<Sender<Q>>,
    answers: Receiver<A>,
    /// True from a question to its answer.
    is_out: bool,
    thread: Option<JoinHandle<()>>,
}

/// Waiter whose thread has ended before its time.
#[derive(Debug, thiserror::Error)]
#[error("the thread that asks a window for its textures has ended; restart the program")]
pub struct WaiterGone;

impl<Q: Send + 'static, A: Send + 'static> TextureWaiter<Q, A> {
    /// Starts the thread. `ask`: the question, which is gone when its answer comes.
    ///
    /// # Errors
    /// Refusal of the system.
    pub fn new(ask: impl Fn(Q) -> A + Send + 'static) -> io::Result<Self> {
        let (questions, asked) = bounded::<Q>(1);
        let (answered, answers) = bounded(1);
        let serve = move || {
            for question in asked {
                if answered.send(ask(question)).is_err() {
                    break;
                }
            }
        };
        let thread = Builder::new().name("window textures".to_owned()).spawn(serve)?;
        Ok(Self { questions: Some(questions), answers, is_out: false, thread: Some(thread) })
    }

    /// True from a question to its answer.
    pub fn is_out(&self) -> bool {
        self.is_out
    }

    /// Asks, unless a question is out.
    ///
    /// # Errors
    /// [`WaiterGone`] after a panic in the thread.
    pub fn ask(&mut self, question: impl FnOnce() -> Q) -> Result<(), WaiterGone> {
        if !self.is_out {
            self.questions.as_ref().ok_or(WaiterGone)?.send(question()).map_err(|_| WaiterGone)?;
            self.is_out = true;
        }
        Ok(())
    }

    /// Answer, if it comes before `until`.
    ///
    /// # Errors
    /// [`WaiterGone`] after a panic in the thread.
    pub fn answer(&mut self, until: Instant) -> Result<Option<A>, WaiterGone> {
        if !self.is_out {
            return Ok(None);
        }
        match self.answers.recv_deadline(until) {
            Ok(answer) => {
                self.is_out = false;
                Ok(Some(answer))
            }
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(WaiterGone),
        }
    }
}

impl<Q, A> Drop for TextureWaiter<Q, A> {
    /// Ends the thread after the answer that is out: nothing of the window is in use afterwards.
    fn drop(&mut self) {
        self.questions = None;
        if let Some(thread) = self.thread.take() {
            // A thread that has panicked has said so.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: a window that does not answer keeps nobody else, its answer is not lost when it comes late, and nothing of
    //! it is in use once its waiter is dropped.
    #![allow(clippy::unwrap_used, clippy::panic, reason = "a thread that does not start is a failed test")]

    use super::*;
    use std::sync::Arc;
    use std::time::Duration;

    fn in_a_second() -> Instant {
        Instant::now() + Duration::from_secs(1)
    }

    #[test]
    fn waits_of_several_windows_pass_side_by_side() {
        let wait = Duration::from_millis(200);
        let sleepy = |number: u32| {
            std::thread::sleep(Duration::from_millis(200));
            number
        };
        let mut waiters: Vec<_> = (0..5).map(|_| TextureWaiter::new(sleepy).unwrap()).collect();
        let began = Instant::now();
        waiters.iter_mut().for_each(|waiter| waiter.ask(|| 7).unwrap());
        assert!(waiters.iter_mut().all(|waiter| waiter.answer(in_a_second()).unwrap() == Some(7)));
        assert!(began.elapsed() < 3 * wait, "{:?}", began.elapsed());
    }

    #[test]
    fn a_late_answer_comes_in_a_later_turn_and_is_asked_for_once() {
        let (release, gate) = bounded::<()>(1);
        let mut waiter = TextureWaiter::new(move |number: u32| {
            gate.recv().unwrap();
            number
        })
        .unwrap();
        assert_eq!(waiter.answer(in_a_second()).unwrap(), None, "nothing was asked");
        for number in 1..4 {
            waiter.ask(|| number).unwrap();
            assert_eq!(waiter.answer(Instant::now()).unwrap(), None);
            assert!(waiter.is_out());
        }
        release.send(()).unwrap();
        assert_eq!(waiter.answer(in_a_second()).unwrap(), Some(1));
        assert!(!waiter.is_out());
    }

    #[test]
    fn nothing_is_in_use_after_the_drop() {
        let surface = Arc::new(());
        let mut waiter = TextureWaiter::new(|surface: Arc<()>| {
            std::thread::sleep(Duration::from_millis(50));
            surface
        })
        .unwrap();
        waiter.ask(|| Arc::clone(&surface)).unwrap();
        drop(waiter);
        assert_eq!(Arc::strong_count(&surface), 1);
    }

    #[test]
    fn a_thread_that_is_gone_is_an_error() {
        let mut waiter = TextureWaiter::new(|(): ()| -> u32 { panic!("a driver's fault, in this test only") }).unwrap();
        waiter.ask(|| ()).unwrap();
        assert!(waiter.answer(in_a_second()).is_err());
    }
}
