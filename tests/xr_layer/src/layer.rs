//! State of the layer: what the program has been told, and what the test has asked for.

use crate::command::LayerCommand;
use crate::next::NextFunctions;
use openxr::sys::{
    Action, Duration, Path, Posef, ReferenceSpaceType, Session, SessionState, Space, SpaceVelocityFlags, Time,
};
use std::collections::{HashMap, VecDeque};
use std::io::Write;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Name of the variable that names the file with the commands.
pub(crate) const COMMANDS: &str = "RAPIDITY_XR_LAYER";
/// Ending of the journal beside that file: what was played out, and what the program did.
pub(crate) const JOURNAL: &str = "journal";

/// Extension that the layer offers.
pub(crate) const INSETS_EXTENSION: &str = "XR_VARJO_quad_views";
/// First command of a headset with insets.
const INSETS: &str = "insets\n";

/// Event that waits for the program.
#[derive(Clone, Copy)]
pub(crate) enum LayerEvent {
    /// Next state of the session.
    State(SessionState),
    /// End of the runtime.
    InstanceLoss,
    /// Space that moves at a time.
    Moves(ReferenceSpaceType, Time),
}

/// Kind of a space, as far as it matters.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum SpaceKind {
    /// The head.
    View,
    /// The room.
    Stage,
    /// A hand.
    Hand,
}

/// State of the layer.
pub(crate) struct Layer {
    /// Functions that calls are passed on to.
    pub(crate) next: NextFunctions,
    /// Session of the program.
    pub(crate) session: Session,
    /// State of which the program knows.
    pub(crate) state: SessionState,
    /// State of which the runtime has told.
    pub(crate) runtime_state: SessionState,
    /// True if the runtime's session runs.
    pub(crate) begun: bool,
    /// True if the program's session runs.
    pub(crate) running: bool,
    /// True if a picture was handed over since the session began.
    pub(crate) pictured: bool,
    /// True if the session is lost without a word.
    pub(crate) lost: bool,
    /// True if the head is in sight.
    pub(crate) head: bool,
    /// Velocity of the head, m/s, if the runtime knows it.
    pub(crate) velocity: Option<[f32; 3]>,
    /// True if the headset has finer views within those of both eyes.
    pub(crate) insets: bool,
    /// Events that wait for the program.
    pub(crate) waiting: VecDeque<LayerEvent>,
    /// Time at which the last frame is seen, and that of a frame.
    pub(crate) frame: (Time, Duration),
    /// Kinds of the program's spaces.
    pub(crate) spaces: HashMap<Space, SpaceKind>,
    /// Places that the stage has been moved to, and when.
    pub(crate) moves: Vec<(Time, Posef)>,
    /// Spaces of the runtime in place of a moved stage, by the number of its move.
    pub(crate) moved: HashMap<usize, Space>,
    /// Names of the program's actions.
    pub(crate) actions: HashMap<Action, String>,
    /// Right hand.
    pub(crate) right: Path,
    /// Actions that the right hand holds.
    pub(crate) held: HashMap<String, [f32; 2]>,
    commands: Option<PathBuf>,
    lines_done: usize,
}

static LAYER: Mutex<Option<Layer>> = Mutex::new(None);

/// Runs `work` on the layer of the instance. Calls of the runtime are made outside of it, since they may wait.
pub(crate) fn with<T>(work: impl FnOnce(&mut Layer) -> T) -> T {
    work(LAYER.lock().unwrap_or_else(PoisonError::into_inner).as_mut().expect("the loader makes the instance first"))
}

impl Layer {
    /// Puts a new layer in place, for a new instance.
    pub(crate) fn begin(next: NextFunctions) {
        let commands = std::env::var_os(COMMANDS).map(PathBuf::from);
        let text = commands.as_ref().and_then(|path| std::fs::read_to_string(path).ok()).unwrap_or_default();
        let insets = text.starts_with(INSETS);
        let layer = Self {
            next,
            session: openxr::sys::Handle::from_raw(0),
            state: SessionState::UNKNOWN,
            runtime_state: SessionState::UNKNOWN,
            begun: false,
            running: false,
            pictured: false,
            lost: false,
            head: true,
            velocity: None,
            insets,
            waiting: VecDeque::new(),
            frame: (Time::from_nanos(1), Duration::from_nanos(1)),
            spaces: HashMap::new(),
            moves: Vec::new(),
            moved: HashMap::new(),
            actions: HashMap::new(),
            right: Path::NULL,
            held: HashMap::new(),
            commands,
            lines_done: usize::from(insets),
        };
        *LAYER.lock().unwrap_or_else(PoisonError::into_inner) = Some(layer);
    }

    /// Next event for the program, after the test's next command if none waits.
    pub(crate) fn event(&mut self) -> Option<LayerEvent> {
        while self.waiting.is_empty() && self.command() {}
        let event = self.waiting.pop_front();
        if let Some(LayerEvent::State(state)) = event {
            self.state = state;
        }
        event
    }

    /// Plays out the next command; false if there is none.
    fn command(&mut self) -> bool {
        let text = self.commands.as_ref().and_then(|path| std::fs::read_to_string(path).ok()).unwrap_or_default();
        // A line that is being written has no end yet.
        let Some(line) = text.split_inclusive('\n').nth(self.lines_done).filter(|line| line.ends_with('\n')) else {
            return false;
        };
        self.lines_done += 1;
        match LayerCommand::of(line) {
            Some(LayerCommand::State(state)) => self.waiting.push_back(LayerEvent::State(state)),
            Some(LayerCommand::InstanceLoss) => self.waiting.push_back(LayerEvent::InstanceLoss),
            Some(LayerCommand::SessionLost) => self.lost = true,
            Some(LayerCommand::Head(is_seen)) => self.head = is_seen,
            Some(LayerCommand::Velocity(velocity)) => self.velocity = Some(velocity),
            Some(LayerCommand::Hold(action, how_far)) => drop(self.held.insert(action.to_owned(), how_far)),
            Some(LayerCommand::Recentre(place)) => {
                let at = self.next_but_one();
                self.moves.push((at, place));
                self.waiting.push_back(LayerEvent::Moves(ReferenceSpaceType::STAGE, at));
            }
            Some(LayerCommand::RecentreLocal) => {
                self.waiting.push_back(LayerEvent::Moves(ReferenceSpaceType::LOCAL, self.next_but_one()));
            }
            None => self.note("not understood:"),
        }
        self.note(line.trim());
        true
    }

    /// Time of the frame after the next: a move is announced before it happens.
    fn next_but_one(&self) -> Time {
        let (last, period) = self.frame;
        Time::from_nanos(last.as_nanos() + 2 * period.as_nanos())
    }

    /// Notes in the journal what has happened.
    pub(crate) fn note(&self, what: &str) {
        let Some(path) = self.commands.as_ref().map(|path| path.with_extension(JOURNAL)) else { return };
        if let Ok(mut file) = std::fs::File::options().create(true).append(true).open(path) {
            let _ = writeln!(file, "{what}");
        }
    }

    /// True if the program has keys and hands.
    pub(crate) fn is_focused(&self) -> bool {
        self.state == SessionState::FOCUSED
    }

    /// True if the program's pictures are seen.
    pub(crate) fn is_visible(&self) -> bool {
        self.is_focused() || self.state == SessionState::VISIBLE
    }

    /// Distance that the right hand holds an action, on its axes.
    pub(crate) fn held(&self, action: Action, hand: Path) -> Option<[f32; 2]> {
        let name = self.actions.get(&action).filter(|_| hand == self.right)?;
        self.held.get(name).copied()
    }

    /// Number of the stage's last move before a time, and the place that it was moved to.
    pub(crate) fn moved_by(&self, at: Time) -> Option<(usize, Posef)> {
        let before = |(time, _): &(Time, Posef)| time.as_nanos() <= at.as_nanos();
        let number = self.moves.iter().rposition(before)?;
        Some((number, self.moves[number].1))
    }

    /// Velocity as a runtime says it.
    pub(crate) fn velocity(&self) -> Option<([f32; 3], SpaceVelocityFlags)> {
        self.velocity.map(|velocity| (velocity, SpaceVelocityFlags::LINEAR_VALID))
    }
}
