//! Runtime of a headset: loaded, asked what it can, and followed through the states of a session.

use super::report::XrPose;
use openxr as xr;
use thiserror::Error;

/// Reason why a headset cannot be used. The words of the runtime stay as it says them.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum XrFault {
    /// A machine without the OpenXR loader, and the system's reason.
    #[error("there is no OpenXR loader ({0}): on Debian or Ubuntu `sudo apt-get install libopenxr-loader1`")]
    NoLoader(String),
    /// A machine on which no runtime answers, and the loader's reason.
    #[error("no OpenXR runtime answers ({0}): start that of the headset (SteamVR, Monado, WiVRn) first")]
    NoRuntime(String),
    /// A runtime, by its name, without an extension.
    #[error("{0} lacks {1}, which is needed for this: use another OpenXR runtime, or a newer one")]
    Lacks(String, &'static str),
    /// A runtime, by its name, that sees no headset.
    #[error("{0} sees no headset: plug it in and switch it on")]
    NoHeadset(String),
    /// A request that a runtime, by its name, refused, and its reason.
    #[error("{0} refuses {1}: {2}")]
    Refused(String, &'static str, String),
    /// A session that a runtime, by its name, ended.
    #[error("{0} has ended the session")]
    Ended(String),
}

/// Runtime that answers, with its headset.
pub struct XrRuntime {
    /// Connection to the runtime.
    pub instance: xr::Instance,
    /// Headset.
    pub system: xr::SystemId,
    /// Kind of views: one for each eye, or two for each where the headset wants that.
    pub views: xr::ViewConfigurationType,
    /// True if the runtime takes the depth of pictures.
    pub takes_depth: bool,
    /// True if the runtime knows which parts of its pictures no lens shows.
    pub knows_masks: bool,
    /// True if the runtime can be asked for a frame rate.
    pub knows_rates: bool,
    knows_time: bool,
    name: String,
}

/// Extensions that a session needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum XrUse {
    /// Poses and buttons without pictures.
    Tracker,
    /// Pictures drawn with Vulkan.
    Pictures,
}

impl XrRuntime {
    /// Reaches the runtime and its headset.
    ///
    /// # Errors
    /// What is missing, with what to do about it.
    pub fn new(wanted: XrUse) -> Result<Self, XrFault> {
        // SAFETY: the loader is the system's own library of that name, whose interface the `openxr` crate declares.
        let entry = unsafe { xr::Entry::load(&()) }.map_err(|error| {
            let why = std::error::Error::source(&error).map_or_else(|| error.to_string(), ToString::to_string);
            XrFault::NoLoader(one_line(&why))
        })?;
        let no_runtime = |result: xr::sys::Result| XrFault::NoRuntime(one_line(&result.to_string()));
        let there = entry.enumerate_extensions().map_err(no_runtime)?;
        let mut extensions = xr::ExtensionSet::default();
        extensions.ext_local_floor = there.ext_local_floor;
        extensions.khr_convert_timespec_time = there.khr_convert_timespec_time;
        let needed = match wanted {
            XrUse::Tracker => {
                extensions.mnd_headless = true;
                [
                    (there.mnd_headless, "XR_MND_headless"),
                    (there.khr_convert_timespec_time, "XR_KHR_convert_timespec_time"),
                ]
                .to_vec()
            }
            XrUse::Pictures => {
                extensions.khr_vulkan_enable2 = true;
                extensions.khr_composition_layer_depth = there.khr_composition_layer_depth;
                extensions.khr_visibility_mask = there.khr_visibility_mask;
                extensions.fb_display_refresh_rate = there.fb_display_refresh_rate;
                extensions.varjo_quad_views = there.varjo_quad_views;
                [(there.khr_vulkan_enable2, "XR_KHR_vulkan_enable2")].to_vec()
            }
        };
        let application = xr::ApplicationInfo {
            application_name: "Rapidity",
            engine_name: "Rapidity",
            api_version: xr::Version::new(1, 0, 0),
            ..Default::default()
        };
        let name_of = |instance: xr::Instance| instance.properties().map(|known| known.runtime_name);
        let unnamed = |_| "the OpenXR runtime".to_owned();
        if let Some((_, lacking)) = needed.into_iter().find(|(is_there, _)| !is_there) {
            // A runtime says its name to whoever wants nothing of it.
            let plain = entry.create_instance(&application, &xr::ExtensionSet::default(), &[], &());
            return Err(XrFault::Lacks(plain.and_then(name_of).unwrap_or_else(unnamed), lacking));
        }
        let instance = entry.create_instance(&application, &extensions, &[], &()).map_err(no_runtime)?;
        let name = name_of(instance.clone()).unwrap_or_else(unnamed);
        let system = instance.system(xr::FormFactor::HEAD_MOUNTED_DISPLAY).map_err(|result| match result {
            xr::sys::Result::ERROR_FORM_FACTOR_UNAVAILABLE | xr::sys::Result::ERROR_FORM_FACTOR_UNSUPPORTED => {
                XrFault::NoHeadset(name.clone())
            }
            other => XrFault::Refused(name.clone(), "the headset", one_line(&other.to_string())),
        })?;
        let foveated = xr::ViewConfigurationType::PRIMARY_STEREO_WITH_FOVEATED_INSET;
        let known = instance.enumerate_view_configurations(system).unwrap_or_default();
        let has_insets = extensions.varjo_quad_views && known.contains(&foveated);
        Ok(Self {
            instance,
            system,
            views: if has_insets { foveated } else { xr::ViewConfigurationType::PRIMARY_STEREO },
            takes_depth: extensions.khr_composition_layer_depth,
            knows_masks: extensions.khr_visibility_mask,
            knows_rates: extensions.fb_display_refresh_rate,
            knows_time: extensions.khr_convert_timespec_time,
            name,
        })
    }

    /// Present time of the runtime's clock, if it can be read.
    pub fn now(&self) -> Option<xr::Time> {
        if self.knows_time { self.instance.now().ok() } else { None }
    }

    /// Name that the runtime gives itself.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name of the headset.
    pub fn headset(&self) -> String {
        self.instance.system_properties(self.system).map_or_else(|_| "headset".to_owned(), |known| known.system_name)
    }

    /// Fault of a request that was refused. `what`: the thing that was asked for.
    pub fn refused(&self, what: &'static str) -> impl Fn(xr::sys::Result) -> XrFault + '_ {
        move |result| match result {
            xr::sys::Result::ERROR_INSTANCE_LOST
            | xr::sys::Result::ERROR_SESSION_LOST
            | xr::sys::Result::ERROR_RUNTIME_FAILURE => XrFault::Ended(self.name.clone()),
            other => XrFault::Refused(self.name.clone(), what, one_line(&other.to_string())),
        }
    }

    /// Session without pictures.
    ///
    /// # Errors
    /// A runtime that refuses.
    pub fn headless(&self) -> Result<xr::Session<xr::Headless>, XrFault> {
        // SAFETY: a headless session uses no graphics device, whose validity is all that the call demands.
        let made =
            unsafe { self.instance.create_session::<xr::Headless>(self.system, &xr::headless::SessionCreateInfo {}) };
        made.map(|(session, _, _)| session).map_err(self.refused("a session without pictures"))
    }

    /// Stage of a session: the floor of the room; with runtimes that know none, the floor below the head's first
    /// place, or that place itself.
    ///
    /// # Errors
    /// A runtime that refuses all.
    pub fn stage<G>(&self, session: &xr::Session<G>) -> Result<xr::Space, XrFault> {
        use xr::ReferenceSpaceType as Kind;
        let known = session.enumerate_reference_spaces().map_err(self.refused("its spaces"))?;
        let kinds = [Kind::STAGE, Kind::LOCAL_FLOOR, Kind::LOCAL];
        let kind = kinds.into_iter().find(|kind| known.contains(kind)).unwrap_or(Kind::LOCAL);
        session.create_reference_space(kind, xr::Posef::IDENTITY).map_err(self.refused("a space"))
    }

    /// Pose of a space in another of the same session, and how it moves, at a time of the runtime's clock.
    ///
    /// # Errors
    /// A session that is lost.
    pub fn locate(&self, space: &xr::Space, base: &xr::Space, at: xr::Time) -> xr::Result<XrPose> {
        let zero = xr::Vector3f { x: 0.0, y: 0.0, z: 0.0 };
        let mut motion = xr::sys::SpaceVelocity {
            ty: xr::sys::SpaceVelocity::TYPE,
            next: std::ptr::null_mut(),
            velocity_flags: xr::SpaceVelocityFlags::EMPTY,
            linear_velocity: zero,
            angular_velocity: zero,
        };
        let mut place = xr::sys::SpaceLocation {
            ty: xr::sys::SpaceLocation::TYPE,
            next: (&raw mut motion).cast(),
            location_flags: xr::SpaceLocationFlags::EMPTY,
            pose: xr::Posef::IDENTITY,
        };
        // SAFETY: both spaces are alive, and both structures are whole and outlive the call. The crate's own `relate`
        // leaves their flags as the memory was, which validation refuses.
        let result = unsafe { (self.instance.fp().locate_space)(space.as_raw(), base.as_raw(), at, &raw mut place) };
        if result.into_raw() < 0 {
            return Err(result);
        }
        Ok(known(&place, &motion))
    }

    /// Takes the events since the last call: begins and ends the session as the runtime demands.
    ///
    /// # Errors
    /// A session that has ended for good.
    pub fn follow<G>(&self, session: &xr::Session<G>, state: &mut XrState) -> Result<XrNews, XrFault> {
        let mut news = XrNews::default();
        let mut storage = xr::EventDataBuffer::new();
        while let Some(event) = self.instance.poll_event(&mut storage).map_err(self.refused("its events"))? {
            let ended = || XrFault::Ended(self.name.clone());
            match event {
                xr::Event::SessionStateChanged(change) => match change.state() {
                    xr::SessionState::READY => {
                        session.begin(self.views).map_err(self.refused("to begin the session"))?;
                        *state = XrState::Running { focused: false };
                    }
                    xr::SessionState::STOPPING => {
                        session.end().map_err(self.refused("to end the session"))?;
                        *state = XrState::Idle;
                    }
                    xr::SessionState::FOCUSED => *state = XrState::Running { focused: true },
                    xr::SessionState::VISIBLE | xr::SessionState::SYNCHRONIZED => {
                        *state = XrState::Running { focused: false };
                    }
                    xr::SessionState::LOSS_PENDING | xr::SessionState::EXITING => return Err(ended()),
                    _ => {}
                },
                // Some runtimes move their stage, others the seat beside it alone: the user means the same.
                xr::Event::ReferenceSpaceChangePending(change) => news.stage_moves.push(change.change_time()),
                xr::Event::VisibilityMaskChangedKHR(_) => news.masks_changed = true,
                xr::Event::InstanceLossPending(_) => return Err(ended()),
                _ => {}
            }
        }
        Ok(news)
    }
}

/// What the runtime knows of a pose; numbers that are not finite are not known.
fn known(place: &xr::sys::SpaceLocation, motion: &xr::sys::SpaceVelocity) -> XrPose {
    let finite = |vector: xr::Vector3f| {
        let numbers = [vector.x, vector.y, vector.z];
        numbers.iter().all(|number| number.is_finite()).then_some(numbers)
    };
    let is = |flag| place.location_flags.contains(flag);
    let moves = |flag| motion.velocity_flags.contains(flag);
    let xr::Posef { position, orientation: turn } = place.pose;
    let turn = [turn.x, turn.y, turn.z, turn.w];
    XrPose {
        position_m: finite(position).filter(|_| is(xr::SpaceLocationFlags::POSITION_VALID)),
        orientation: (is(xr::SpaceLocationFlags::ORIENTATION_VALID) && turn.iter().all(|number| number.is_finite()))
            .then_some(turn),
        velocity_m_s: finite(motion.linear_velocity).filter(|_| moves(xr::SpaceVelocityFlags::LINEAR_VALID)),
        turning_rad_s: finite(motion.angular_velocity).filter(|_| moves(xr::SpaceVelocityFlags::ANGULAR_VALID)),
    }
}

/// News of a runtime, besides the state of the session.
#[derive(Clone, Debug, Default)]
pub struct XrNews {
    /// Times at which the runtime moves the places that its spaces are about: its user has recentred, or set the room
    /// up anew.
    pub stage_moves: Vec<xr::Time>,
    /// True if other parts of the pictures than before are those that no lens shows.
    pub masks_changed: bool,
}

/// State of a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum XrState {
    /// No frames and no input: the headset rests, or the runtime has not begun.
    #[default]
    Idle,
    /// The session runs.
    Running {
        /// True if controllers and keys of the headset are this program's.
        focused: bool,
    },
}

/// A reason of several lines, joined into one.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
