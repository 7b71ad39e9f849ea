//! Hands: where controllers aim, and what they hold, of whatever make they are.

use openxr as xr;

use super::report::{XrHand, XrReport};
use super::runtime::{XrFault, XrRuntime};

/// Actions of a hand, by what they are on this program's wand.
struct Actions {
    aim: xr::Action<xr::Posef>,
    /// Buttons, in the order of their numbers.
    buttons: [xr::Action<bool>; 4],
    stick: xr::Action<xr::Vector2f>,
    trigger: xr::Action<f32>,
    grip: xr::Action<f32>,
}

/// Paths of one make of controllers: what chooses, the menu, the stick's press, the grip's; stick, trigger, grip. Each
/// is for both hands, or for the left and the right one; empty where there is none.
struct Make {
    profile: &'static str,
    buttons: [[&'static str; 2]; 4],
    stick: &'static str,
    trigger: &'static str,
    grip: &'static str,
}

/// Makes whose paths are known; the runtime translates others.
const MAKES: [Make; 5] = [
    Make {
        profile: "khr/simple_controller",
        buttons: [["select/click"; 2], ["menu/click"; 2], [""; 2], [""; 2]],
        stick: "",
        trigger: "",
        grip: "",
    },
    Make {
        profile: "oculus/touch_controller",
        buttons: [["x/click", "a/click"], ["y/click", "b/click"], ["thumbstick/click"; 2], [""; 2]],
        stick: "thumbstick",
        trigger: "trigger/value",
        grip: "squeeze/value",
    },
    Make {
        profile: "valve/index_controller",
        buttons: [["a/click"; 2], ["b/click"; 2], ["thumbstick/click"; 2], [""; 2]],
        stick: "thumbstick",
        trigger: "trigger/value",
        grip: "squeeze/value",
    },
    Make {
        profile: "htc/vive_controller",
        buttons: [[""; 2], ["menu/click"; 2], ["trackpad/click"; 2], ["squeeze/click"; 2]],
        stick: "trackpad",
        trigger: "trigger/value",
        grip: "",
    },
    Make {
        profile: "microsoft/motion_controller",
        buttons: [[""; 2], ["menu/click"; 2], ["thumbstick/click"; 2], ["squeeze/click"; 2]],
        stick: "thumbstick",
        trigger: "trigger/value",
        grip: "",
    },
];

/// Head and hands of a session.
pub struct XrHands {
    set: xr::ActionSet,
    actions: Actions,
    /// Paths of the left and the right hand, and where they aim.
    hands: [(xr::Path, xr::Space); 2],
    head: xr::Space,
    stage: xr::Space,
    /// Times at which the runtime moves its stage, and the number of those that are over, modulo 256.
    moves: (Vec<xr::Time>, u8),
}

impl XrHands {
    /// Head and hands of a session that has not begun, in the runtime's stage.
    ///
    /// # Errors
    /// A runtime that refuses an action or a space.
    pub fn new<G>(runtime: &XrRuntime, session: &xr::Session<G>) -> Result<Self, XrFault> {
        let hands = runtime.refused("the controllers");
        let path = |text: &str| runtime.instance.string_to_path(text).map_err(&hands);
        let sides = [path("/user/hand/left")?, path("/user/hand/right")?];
        let set = runtime.instance.create_action_set("ride", "Ride", 0).map_err(&hands)?;
        let button = |name, shown| set.create_action::<bool>(name, shown, &sides).map_err(&hands);
        let axis = |name, shown| set.create_action::<f32>(name, shown, &sides).map_err(&hands);
        let actions = Actions {
            aim: set.create_action("aim", "Aim", &sides).map_err(&hands)?,
            buttons: [
                button("choose", "Choose")?,
                button("menu", "Menu")?,
                button("stick_pressed", "Press the stick")?,
                button("grip_pressed", "Press the grip")?,
            ],
            stick: set.create_action("stick", "Ride and steer", &sides).map_err(&hands)?,
            trigger: axis("trigger", "Trigger")?,
            grip: axis("grip", "Grip")?,
        };
        for make in &MAKES {
            let profile = path(&format!("/interaction_profiles/{}", make.profile))?;
            let bindings = actions.bindings(make, &path)?;
            runtime.instance.suggest_interaction_profile_bindings(profile, &bindings).map_err(&hands)?;
        }
        session.attach_action_sets(&[&set]).map_err(&hands)?;
        let aims = |side| actions.aim.create_space(session, side, xr::Posef::IDENTITY).map_err(&hands);
        let spaces = [(sides[0], aims(sides[0])?), (sides[1], aims(sides[1])?)];
        let head = session
            .create_reference_space(xr::ReferenceSpaceType::VIEW, xr::Posef::IDENTITY)
            .map_err(runtime.refused("the head's place"))?;
        let (stage, moves) = (runtime.stage(session)?, (Vec::new(), 0));
        Ok(Self { set, actions, hands: spaces, head, stage, moves })
    }

    /// Space in which the poses are.
    pub fn stage(&self) -> &xr::Space {
        &self.stage
    }

    /// Takes the times at which the runtime moves its stage, as it has announced them.
    pub fn stage_moves_at(&mut self, times: Vec<xr::Time>) {
        self.moves.0.extend(times);
    }

    /// Report on head and hands at a time of the runtime's clock.
    ///
    /// # Errors
    /// A session that is lost.
    pub fn report<G>(
        &mut self,
        runtime: &XrRuntime,
        session: &xr::Session<G>,
        at: xr::Time,
    ) -> Result<XrReport, XrFault> {
        let lost = runtime.refused("the poses");
        // Poses of a time before the move are still where the stage was.
        let (announced, over) = &mut self.moves;
        let waiting = announced.len();
        announced.retain(|time| time.as_nanos() > at.as_nanos());
        *over = over.wrapping_add((waiting - announced.len()) as u8);
        let stage_moves = *over;
        session.sync_actions(&[xr::ActiveActionSet::new(&self.set)]).map_err(&lost)?;
        let pose = |space: &xr::Space| runtime.locate(space, &self.stage, at).map_err(&lost);
        let hand = |(side, space): &(xr::Path, xr::Space)| -> Result<XrHand, XrFault> {
            let mut buttons = 0;
            for (number, button) in self.actions.buttons.iter().enumerate() {
                buttons |= u32::from(button.state(session, *side).map_err(&lost)?.current_state) << number;
            }
            let stick = self.actions.stick.state(session, *side).map_err(&lost)?.current_state;
            let axis = |action: &xr::Action<f32>| Ok(action.state(session, *side).map_err(&lost)?.current_state);
            let axes = [stick.x, stick.y, axis(&self.actions.trigger)?, axis(&self.actions.grip)?];
            Ok(XrHand { pose: pose(space)?, buttons, axes: axes.map(|axis| if axis.is_finite() { axis } else { 0.0 }) })
        };
        let hands = [hand(&self.hands[0])?, hand(&self.hands[1])?];
        Ok(XrReport { time_ns: at.as_nanos(), head: pose(&self.head)?, hands, stage_moves })
    }
}

impl Actions {
    /// Bindings of the actions for a make of controllers.
    fn bindings<'a>(
        &'a self,
        make: &Make,
        path: &impl Fn(&str) -> Result<xr::Path, XrFault>,
    ) -> Result<Vec<xr::Binding<'a>>, XrFault> {
        let mut bindings = Vec::new();
        for (number, side) in ["left", "right"].into_iter().enumerate() {
            let input = |name: &str| path(&format!("/user/hand/{side}/input/{name}"));
            bindings.push(xr::Binding::new(&self.aim, input("aim/pose")?));
            for (action, names) in self.buttons.iter().zip(&make.buttons) {
                if !names[number].is_empty() {
                    bindings.push(xr::Binding::new(action, input(names[number])?));
                }
            }
            if !make.stick.is_empty() {
                bindings.push(xr::Binding::new(&self.stick, input(make.stick)?));
            }
            for (action, name) in [(&self.trigger, make.trigger), (&self.grip, make.grip)] {
                if !name.is_empty() {
                    bindings.push(xr::Binding::new(action, input(name)?));
                }
            }
        }
        Ok(bindings)
    }
}
