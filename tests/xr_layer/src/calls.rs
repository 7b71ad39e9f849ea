//! Calls of the program, answered or passed on.
//!
//! Every pointer that comes in is the program's, valid by the standard for the time of the call. The layer writes what
//! the standard has a runtime write, and hands on copies where it changes what the program has said.

use crate::insets::{
    below, enumerate_blend_modes, enumerate_view_configurations, enumerate_views, visibility_mask, with_insets,
};
use crate::layer::{INSETS_EXTENSION, Layer, LayerEvent, SpaceKind, with};
use crate::next::NextFunctions;
use openxr::sys::{self, Handle, Result, SessionState, Space, Time, pfn};
use std::ffi::{CStr, c_char};

/// Tells the loader where the layer begins.
///
/// # Safety
/// Called by the loader, with structures that are whole.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn xrNegotiateLoaderApiLayerInterface(
    _loader: *const sys::NegotiateLoaderInfo,
    _name: *const c_char,
    request: *mut sys::NegotiateApiLayerRequest,
) -> Result {
    // SAFETY: the request is the loader's, and whole.
    let request = unsafe { &mut *request };
    request.layer_interface_version = 1;
    request.layer_api_version = sys::Version::new(1, 0, 0);
    request.get_instance_proc_addr = Some(find);
    request.create_api_layer_instance = Some(create);
    Result::SUCCESS
}

unsafe extern "system" fn create(
    info: *const sys::InstanceCreateInfo,
    layer: *const sys::ApiLayerCreateInfo,
    instance: *mut sys::Instance,
) -> Result {
    // SAFETY: the loader's structures are whole, and name this layer first, which is taken out for the next one.
    unsafe {
        let own = &*(*layer).next_info;
        let under = sys::ApiLayerCreateInfo { next_info: own.next, ..*layer };
        let (Some(create), Some(find)) = (own.next_create_api_layer_instance, own.next_get_instance_proc_addr) else {
            return Result::ERROR_INITIALIZATION_FAILED;
        };
        // The layer alone knows of the extension that it offers.
        let names =
            std::slice::from_raw_parts((*info).enabled_extension_names, (*info).enabled_extension_count as usize);
        let is_known = |name: &*const c_char| CStr::from_ptr(*name).to_bytes() != INSETS_EXTENSION.as_bytes();
        let names: Vec<*const c_char> = names.iter().copied().filter(is_known).collect();
        let info = sys::InstanceCreateInfo {
            enabled_extension_count: names.len() as u32,
            enabled_extension_names: names.as_ptr(),
            ..*info
        };
        let made = create(&raw const info, &raw const under, instance);
        if made.into_raw() < 0 {
            return made;
        }
        let Some(next) = NextFunctions::of(find, *instance) else { return Result::ERROR_INITIALIZATION_FAILED };
        Layer::begin(next);
        made
    }
}

/// Finds the layer's own functions, and the others in the next layer.
unsafe extern "system" fn find(
    instance: sys::Instance,
    name: *const c_char,
    function: *mut Option<pfn::VoidFunction>,
) -> Result {
    macro_rules! own {
        ($call:ident: $kind:ident) => {
            // SAFETY: the function has the type that the standard gives the name.
            unsafe { std::mem::transmute::<pfn::$kind, pfn::VoidFunction>($call) }
        };
    }
    // SAFETY: the name ends with a zero.
    let own = match unsafe { CStr::from_ptr(name) }.to_bytes() {
        b"xrPollEvent" => own!(poll_event: PollEvent),
        b"xrEnumerateViewConfigurations" => {
            own!(enumerate_view_configurations: EnumerateViewConfigurations)
        }
        b"xrEnumerateViewConfigurationViews" => own!(enumerate_views: EnumerateViewConfigurationViews),
        b"xrEnumerateEnvironmentBlendModes" => own!(enumerate_blend_modes: EnumerateEnvironmentBlendModes),
        b"xrGetVisibilityMaskKHR" => own!(visibility_mask: GetVisibilityMaskKHR),
        b"xrBeginSession" => own!(begin_session: BeginSession),
        b"xrEndSession" => own!(end_session: EndSession),
        b"xrWaitFrame" => own!(wait_frame: WaitFrame),
        b"xrBeginFrame" => own!(begin_frame: BeginFrame),
        b"xrEndFrame" => own!(end_frame: EndFrame),
        b"xrCreateReferenceSpace" => own!(create_reference_space: CreateReferenceSpace),
        b"xrCreateActionSpace" => own!(create_action_space: CreateActionSpace),
        b"xrLocateSpace" => own!(locate_space: LocateSpace),
        b"xrLocateViews" => own!(locate_views: LocateViews),
        b"xrCreateAction" => own!(create_action: CreateAction),
        b"xrStringToPath" => own!(string_to_path: StringToPath),
        b"xrSyncActions" => own!(sync_actions: SyncActions),
        b"xrGetActionStateBoolean" => own!(get_boolean: GetActionStateBoolean),
        b"xrGetActionStateFloat" => own!(get_float: GetActionStateFloat),
        b"xrGetActionStateVector2f" => own!(get_vector: GetActionStateVector2f),
        // SAFETY: passed on as it came.
        _ => return unsafe { (with(|layer| layer.next).find)(instance, name, function) },
    };
    // SAFETY: the place is the program's.
    unsafe { *function = Some(own) };
    Result::SUCCESS
}

unsafe extern "system" fn poll_event(instance: sys::Instance, data: *mut sys::EventDataBuffer) -> Result {
    let (next, event, session, (time, _)) = with(|layer| (layer.next, layer.event(), layer.session, layer.frame));
    let Some(event) = event else {
        // SAFETY: passed on as it came; an event of the runtime has the type that it names.
        unsafe {
            let polled = (next.poll_event)(instance, data);
            if polled == Result::SUCCESS && (*data).ty == sys::EventDataSessionStateChanged::TYPE {
                let change = &*data.cast::<sys::EventDataSessionStateChanged>();
                with(|layer| {
                    layer.session = change.session;
                    (layer.state, layer.runtime_state) = (change.state, change.state);
                });
            }
            return polled;
        }
    };
    let next = std::ptr::null();
    // SAFETY: a buffer of events holds every event, and is aligned for it.
    unsafe {
        match event {
            LayerEvent::State(state) => data.cast::<sys::EventDataSessionStateChanged>().write({
                let ty = sys::EventDataSessionStateChanged::TYPE;
                sys::EventDataSessionStateChanged { ty, next, session, state, time }
            }),
            LayerEvent::InstanceLoss => data.cast::<sys::EventDataInstanceLossPending>().write({
                let ty = sys::EventDataInstanceLossPending::TYPE;
                sys::EventDataInstanceLossPending { ty, next, loss_time: time }
            }),
            LayerEvent::Moves(reference_space_type, change_time) => {
                data.cast::<sys::EventDataReferenceSpaceChangePending>().write({
                    sys::EventDataReferenceSpaceChangePending {
                        ty: sys::EventDataReferenceSpaceChangePending::TYPE,
                        next,
                        session,
                        reference_space_type,
                        change_time,
                        // Runtimes need not say how far.
                        pose_valid: sys::FALSE,
                        pose_in_previous_space: sys::Posef::default(),
                    }
                });
            }
        }
    }
    Result::SUCCESS
}

unsafe extern "system" fn begin_session(session: sys::Session, info: *const sys::SessionBeginInfo) -> Result {
    let (next, begun, state) = with(|layer| (layer.next, layer.begun, layer.state));
    if state != SessionState::READY {
        return Result::ERROR_SESSION_NOT_READY;
    }
    let result = if begun {
        Result::SUCCESS
    } else {
        // SAFETY: passed on with the runtime's kind of views. Its session runs on while the program's rests.
        unsafe {
            let primary_view_configuration_type = below((*info).primary_view_configuration_type);
            let info = sys::SessionBeginInfo { primary_view_configuration_type, ..*info };
            (next.begin_session)(session, &raw const info)
        }
    };
    if result.into_raw() >= 0 {
        with(|layer| {
            (layer.begun, layer.running, layer.pictured) = (true, true, false);
            if begun {
                let states = [SessionState::SYNCHRONIZED, SessionState::VISIBLE, SessionState::FOCUSED];
                layer.waiting.extend(states.map(LayerEvent::State));
            }
            layer.note("session begun");
        });
    }
    result
}

unsafe extern "system" fn end_session(session: sys::Session) -> Result {
    let (next, state, by_runtime) =
        with(|layer| (layer.next, layer.state, layer.runtime_state == SessionState::STOPPING));
    if state != SessionState::STOPPING {
        return Result::ERROR_SESSION_NOT_STOPPING;
    }
    // SAFETY: passed on as it came.
    let result = if by_runtime { unsafe { (next.end_session)(session) } } else { Result::SUCCESS };
    with(|layer| {
        layer.running = false;
        if by_runtime {
            layer.begun = false;
        } else {
            layer.waiting.push_front(LayerEvent::State(SessionState::IDLE));
        }
        layer.note("session ended");
    });
    result
}

/// Refusal of a frame, if the session is lost or does not run.
fn refused() -> Option<Result> {
    with(|layer| match (layer.lost, layer.running) {
        (true, _) => Some(Result::ERROR_SESSION_LOST),
        (_, false) => Some(Result::ERROR_SESSION_NOT_RUNNING),
        _ => None,
    })
}

unsafe extern "system" fn wait_frame(
    session: sys::Session,
    info: *const sys::FrameWaitInfo,
    frame: *mut sys::FrameState,
) -> Result {
    if let Some(refusal) = refused() {
        return refusal;
    }
    let next = with(|layer| layer.next);
    // SAFETY: passed on as it came, and written by the runtime if it has succeeded.
    unsafe {
        let waited = (next.wait_frame)(session, info, frame);
        if waited.into_raw() >= 0 {
            with(|layer| {
                layer.frame = ((*frame).predicted_display_time, (*frame).predicted_display_period);
                if !layer.is_visible() {
                    (*frame).should_render = sys::FALSE;
                }
            });
        }
        waited
    }
}

unsafe extern "system" fn begin_frame(session: sys::Session, info: *const sys::FrameBeginInfo) -> Result {
    // SAFETY: passed on as it came.
    refused().unwrap_or_else(|| unsafe { (with(|layer| layer.next).begin_frame)(session, info) })
}

unsafe extern "system" fn end_frame(session: sys::Session, info: *const sys::FrameEndInfo) -> Result {
    if let Some(refusal) = refused() {
        return refusal;
    }
    let (next, four) = with(|layer| (layer.next, layer.insets));
    // SAFETY: the program's layers are whole, as many as it says. Of a picture's layer all is copied.
    unsafe {
        let info = &*info;
        let count = info.layer_count as usize;
        let layers = if count == 0 { &[] } else { std::slice::from_raw_parts(info.layers, count) };
        let mut copies: Vec<sys::CompositionLayerProjection> = Vec::with_capacity(count);
        let mut handed = Vec::with_capacity(count);
        for &layer in layers {
            if (*layer).ty != sys::CompositionLayerProjection::TYPE {
                handed.push(layer);
                continue;
            }
            let projection = &*layer.cast::<sys::CompositionLayerProjection>();
            let space = in_place(session, projection.space, info.display_time);
            // The copies were given their room, and stay where they are.
            let view_count = if four { projection.view_count.min(2) } else { projection.view_count };
            copies.push(sys::CompositionLayerProjection { space, view_count, ..*projection });
            handed.push(copies.as_ptr().add(copies.len() - 1).cast());
        }
        let info = sys::FrameEndInfo { layers: handed.as_ptr(), ..*info };
        let ended = (next.end_frame)(session, &raw const info);
        with(|layer| {
            layer.note("frame");
            if !copies.is_empty() && ended.into_raw() >= 0 && !std::mem::replace(&mut layer.pictured, true) {
                layer.note("picture");
            }
        });
        ended
    }
}

unsafe extern "system" fn create_reference_space(
    session: sys::Session,
    info: *const sys::ReferenceSpaceCreateInfo,
    space: *mut Space,
) -> Result {
    let next = with(|layer| layer.next);
    // SAFETY: passed on as it came, and written by the runtime if it has succeeded.
    unsafe {
        let made = (next.create_reference_space)(session, info, space);
        let kind = match (*info).reference_space_type {
            sys::ReferenceSpaceType::VIEW => Some(SpaceKind::View),
            sys::ReferenceSpaceType::STAGE => Some(SpaceKind::Stage),
            _ => None,
        };
        if let Some(kind) = kind.filter(|_| made.into_raw() >= 0) {
            with(|layer| layer.spaces.insert(*space, kind));
        }
        made
    }
}

unsafe extern "system" fn create_action_space(
    session: sys::Session,
    info: *const sys::ActionSpaceCreateInfo,
    space: *mut Space,
) -> Result {
    let next = with(|layer| layer.next);
    // SAFETY: passed on as it came, and written by the runtime if it has succeeded.
    unsafe {
        let made = (next.create_action_space)(session, info, space);
        if made.into_raw() >= 0 {
            with(|layer| layer.spaces.insert(*space, SpaceKind::Hand));
        }
        made
    }
}

/// Space of the runtime that is in place of the program's at a time: a stage that was moved is another one.
fn in_place(session: sys::Session, space: Space, at: Time) -> Space {
    let (next, moved) = with(|layer| {
        let is_stage = layer.spaces.get(&space) == Some(&SpaceKind::Stage);
        let moved = layer.moved_by(at).filter(|_| is_stage);
        (layer.next, moved.map(|(number, place)| (number, place, layer.moved.get(&number).copied())))
    });
    match moved {
        None => space,
        Some((_, _, Some(made))) => made,
        Some((number, place, None)) => {
            let info = sys::ReferenceSpaceCreateInfo {
                ty: sys::ReferenceSpaceCreateInfo::TYPE,
                next: std::ptr::null(),
                reference_space_type: sys::ReferenceSpaceType::STAGE,
                pose_in_reference_space: place,
            };
            let mut made = Space::NULL;
            // SAFETY: the session is alive, and both structures are whole.
            let result = unsafe { (next.create_reference_space)(session, &raw const info, &raw mut made) };
            if result.into_raw() < 0 {
                return space;
            }
            with(|layer| layer.moved.insert(number, made));
            made
        }
    }
}

/// Pose that no program may look at.
fn unknown() -> sys::Posef {
    let (x, y, z, w) = (f32::NAN, f32::NAN, f32::NAN, f32::NAN);
    sys::Posef { orientation: sys::Quaternionf { x, y, z, w }, position: sys::Vector3f { x, y, z } }
}

unsafe extern "system" fn locate_space(
    space: Space,
    base: Space,
    at: Time,
    location: *mut sys::SpaceLocation,
) -> Result {
    let (next, session) = with(|layer| (layer.next, layer.session));
    let places = [space, base].map(|space| in_place(session, space, at));
    // SAFETY: passed on as it came, and written by the runtime if it has succeeded; what follows the location is a
    // velocity if it says so.
    unsafe {
        let located = (next.locate_space)(places[0], places[1], at, location);
        if located.into_raw() < 0 {
            return located;
        }
        let (kind, head, focused, velocity) = with(|layer| {
            let kind = layer.spaces.get(&space).copied();
            (kind, layer.head, layer.is_focused(), layer.velocity())
        });
        let motion = (*location).next.cast::<sys::SpaceVelocity>();
        let motion = (!motion.is_null() && (*motion).ty == sys::SpaceVelocity::TYPE).then_some(motion);
        let is_known = match kind {
            Some(SpaceKind::View) => head,
            Some(SpaceKind::Hand) => focused,
            _ => true,
        };
        if !is_known {
            (*location).location_flags = sys::SpaceLocationFlags::EMPTY;
            (*location).pose = unknown();
            if let Some(motion) = motion {
                (*motion).velocity_flags = sys::SpaceVelocityFlags::EMPTY;
            }
        } else if let (Some(SpaceKind::View), Some(motion), Some(([x, y, z], flags))) = (kind, motion, velocity) {
            (*motion).velocity_flags = flags;
            (*motion).linear_velocity = sys::Vector3f { x, y, z };
        }
        located
    }
}

unsafe extern "system" fn locate_views(
    session: sys::Session,
    info: *const sys::ViewLocateInfo,
    state: *mut sys::ViewState,
    capacity: u32,
    count: *mut u32,
    views: *mut sys::View,
) -> Result {
    let (next, head, four) = with(|layer| (layer.next, layer.head, layer.insets));
    // SAFETY: passed on with another space, and written by the runtime if it has succeeded: as many views as it says.
    unsafe {
        let space = in_place(session, (*info).space, (*info).display_time);
        let view_configuration_type = below((*info).view_configuration_type);
        let info = sys::ViewLocateInfo { space, view_configuration_type, ..*info };
        let located = if four && capacity >= 4 {
            let mut two = [*views; 2];
            let located = (next.locate_views)(session, &raw const info, state, 2, count, two.as_mut_ptr());
            std::ptr::copy_nonoverlapping(with_insets(two).as_ptr(), views, 4);
            *count = 4;
            located
        } else if four {
            *count = 4;
            if capacity == 0 { Result::SUCCESS } else { Result::ERROR_SIZE_INSUFFICIENT }
        } else {
            (next.locate_views)(session, &raw const info, state, capacity, count, views)
        };
        if located.into_raw() >= 0 && !head {
            (*state).view_state_flags = sys::ViewStateFlags::EMPTY;
            for number in 0..(*count).min(capacity) as usize {
                (*views.add(number)).pose = unknown();
            }
        }
        located
    }
}

unsafe extern "system" fn create_action(
    set: sys::ActionSet,
    info: *const sys::ActionCreateInfo,
    action: *mut sys::Action,
) -> Result {
    let next = with(|layer| layer.next);
    // SAFETY: passed on as it came, and written by the runtime if it has succeeded; the name ends with a zero.
    unsafe {
        let made = (next.create_action)(set, info, action);
        if made.into_raw() >= 0 {
            let name = CStr::from_ptr((*info).action_name.as_ptr()).to_string_lossy().into_owned();
            with(|layer| layer.actions.insert(*action, name));
        }
        made
    }
}

unsafe extern "system" fn string_to_path(instance: sys::Instance, text: *const c_char, path: *mut sys::Path) -> Result {
    let next = with(|layer| layer.next);
    // SAFETY: passed on as it came, and written by the runtime if it has succeeded; the text ends with a zero.
    unsafe {
        let found = (next.string_to_path)(instance, text, path);
        if found.into_raw() >= 0 && CStr::from_ptr(text).to_bytes() == b"/user/hand/right" {
            with(|layer| layer.right = *path);
        }
        found
    }
}

unsafe extern "system" fn sync_actions(session: sys::Session, info: *const sys::ActionsSyncInfo) -> Result {
    let (next, focused) = with(|layer| (layer.next, layer.is_focused()));
    // SAFETY: passed on as it came, or without any set, whose actions rest then.
    unsafe {
        if focused {
            return (next.sync_actions)(session, info);
        }
        let none = sys::ActionsSyncInfo { count_active_action_sets: 0, active_action_sets: std::ptr::null(), ..*info };
        let synchronized = (next.sync_actions)(session, &raw const none);
        if synchronized.into_raw() >= 0 { Result::SESSION_NOT_FOCUSED } else { synchronized }
    }
}

/// Defines the answer about actions of a kind. `$of` makes its value of what is held.
macro_rules! action_state {
    ($call:ident, $state:ident, $of:expr) => {
        unsafe extern "system" fn $call(
            session: sys::Session,
            info: *const sys::ActionStateGetInfo,
            state: *mut sys::$state,
        ) -> Result {
            // SAFETY: passed on as it came, and written by the runtime if it has succeeded.
            unsafe {
                let (next, focused, held) =
                    with(|layer| (layer.next, layer.is_focused(), layer.held((*info).action, (*info).subaction_path)));
                let answered = (next.$call)(session, info, state);
                if answered.into_raw() >= 0 && (held.is_some() || !focused) {
                    (*state).current_state = $of(held.filter(|_| focused).unwrap_or_default());
                    (*state).is_active = focused.into();
                }
                answered
            }
        }
    };
}

action_state!(get_boolean, ActionStateBoolean, |[x, _]: [f32; 2]| sys::Bool32::from(x != 0.0));
action_state!(get_float, ActionStateFloat, |[x, _]: [f32; 2]| x);
action_state!(get_vector, ActionStateVector2f, |[x, y]: [f32; 2]| sys::Vector2f { x, y });
