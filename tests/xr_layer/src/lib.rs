//! OpenXR API layer between a program and its runtime, which plays out what happens to a headset in use: it is put down
//! and put on, unplugged, loses its focus, its head or its place.
//!
//! A simulated headset does none of this by itself. A test holds a [`LayerScript`] and writes commands into a file; the
//! layer, loaded by the OpenXR loader into the program, reads them when the program asks for events. From then on it
//! says what a runtime would say, and answers for the runtime wherever that is in another state. It is as strict as the
//! standard: a session that is begun, ended or drawn for in a wrong state is refused.
//!
//! | command | plays out |
//! |---|---|
//! | `insets`, as the very first | the headset has finer views within those of both eyes |
//! | `synchronized`, `visible`, `focused` | the session's next state |
//! | `stopping` | the same; after the session's end `idle` comes by itself |
//! | `ready` | the same; after the session's beginning the way to `focused` comes by itself |
//! | `loss_pending`, `exiting` | the session's last state |
//! | `instance_loss` | the runtime is about to end |
//! | `session_lost` | the session is lost without a word |
//! | `head off`, `head on` | the head is out of sight, and seen again |
//! | `velocity X Y Z` | the runtime knows the head's velocity, m/s |
//! | `hold ACTION X Y` | the right hand holds a button, trigger or stick; 0 0 lets go |
//! | `recentre X Y Z YAW` | the runtime moves its stage there, metres and degrees in its first stage |
//! | `recentre local` | the runtime moves another of its spaces, and the stage rests |
//!
//! All commands that are there when the program asks for events are played out at once.
//!
//! A second thing in the same library is a runtime without any extension ([`plain_runtime()`]).

mod calls;
mod command;
mod insets;
mod layer;
mod next;
mod plain_runtime;
mod script;

pub use plain_runtime::{PLAIN_RUNTIME, plain_runtime};
pub use script::LayerScript;
