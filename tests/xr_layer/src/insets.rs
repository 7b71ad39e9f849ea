//! Finer views within those of both eyes, as some headsets have them: the layer plays out a headset with four views
//! over a runtime that has two.

use crate::layer::with;
use openxr::sys::{self, Result, ViewConfigurationType};

/// Kind of views that the layer plays out.
const FOUR: ViewConfigurationType = ViewConfigurationType::PRIMARY_STEREO_WITH_FOVEATED_INSET;
/// Kind of views that the runtime has.
const TWO: ViewConfigurationType = ViewConfigurationType::PRIMARY_STEREO;
/// Angles of an inset, parts of those of the view around it.
const SHARE: f32 = 0.45;
/// Number of eyes.
const EYES: usize = 2;

/// Kind of views that the runtime is asked for in place of the program's.
pub(crate) fn below(kind: ViewConfigurationType) -> ViewConfigurationType {
    if kind == FOUR { TWO } else { kind }
}

/// Answers a question for a list by the standard's two calls.
///
/// # Safety
/// `count` is the program's, and `items` has room for `capacity` of them.
unsafe fn answer<T: Copy>(list: &[T], capacity: u32, count: *mut u32, items: *mut T) -> Result {
    // SAFETY: as the caller promises.
    unsafe {
        *count = list.len() as u32;
        if capacity == 0 {
            return Result::SUCCESS;
        }
        if (capacity as usize) < list.len() {
            return Result::ERROR_SIZE_INSUFFICIENT;
        }
        std::ptr::copy_nonoverlapping(list.as_ptr(), items, list.len());
    }
    Result::SUCCESS
}

pub(crate) unsafe extern "system" fn enumerate_view_configurations(
    instance: sys::Instance,
    system: sys::SystemId,
    capacity: u32,
    count: *mut u32,
    kinds: *mut ViewConfigurationType,
) -> Result {
    let (next, insets) = with(|layer| (layer.next, layer.insets));
    // SAFETY: passed on as it came, or answered.
    unsafe {
        if insets {
            return answer(&[FOUR, TWO], capacity, count, kinds);
        }
        (next.enumerate_view_configurations)(instance, system, capacity, count, kinds)
    }
}

pub(crate) unsafe extern "system" fn enumerate_blend_modes(
    instance: sys::Instance,
    system: sys::SystemId,
    kind: ViewConfigurationType,
    capacity: u32,
    count: *mut u32,
    modes: *mut sys::EnvironmentBlendMode,
) -> Result {
    // SAFETY: passed on with the runtime's kind of views.
    unsafe { (with(|layer| layer.next).enumerate_blend_modes)(instance, system, below(kind), capacity, count, modes) }
}

pub(crate) unsafe extern "system" fn enumerate_views(
    instance: sys::Instance,
    system: sys::SystemId,
    kind: ViewConfigurationType,
    capacity: u32,
    count: *mut u32,
    views: *mut sys::ViewConfigurationView,
) -> Result {
    let next = with(|layer| layer.next);
    // SAFETY: passed on, and answered from what the runtime has written.
    unsafe {
        if kind != FOUR {
            return (next.enumerate_views)(instance, system, kind, capacity, count, views);
        }
        if capacity == 0 {
            *count = 2 * EYES as u32;
            return Result::SUCCESS;
        }
        let mut known = [*views; EYES];
        let mut two = 0;
        let found = (next.enumerate_views)(instance, system, TWO, EYES as u32, &raw mut two, known.as_mut_ptr());
        if found.into_raw() < 0 {
            return found;
        }
        answer(&[known[0], known[1], known[0], known[1]], capacity, count, views)
    }
}

/// Views that the runtime has located, and the insets within them.
pub(crate) fn with_insets(views: [sys::View; EYES]) -> [sys::View; 2 * EYES] {
    let inset = |view: sys::View| {
        let sys::Fovf { angle_left, angle_right, angle_up, angle_down } = view.fov;
        let fov = sys::Fovf {
            angle_left: SHARE * angle_left,
            angle_right: SHARE * angle_right,
            angle_up: SHARE * angle_up,
            angle_down: SHARE * angle_down,
        };
        sys::View { fov, ..view }
    };
    [views[0], views[1], inset(views[0]), inset(views[1])]
}

pub(crate) unsafe extern "system" fn visibility_mask(
    session: sys::Session,
    kind: ViewConfigurationType,
    view: u32,
    of: sys::VisibilityMaskTypeKHR,
    mask: *mut sys::VisibilityMaskKHR,
) -> Result {
    let Some(next) = with(|layer| layer.next.visibility_mask) else { return Result::ERROR_FUNCTION_UNSUPPORTED };
    // SAFETY: passed on, or answered with nothing: lenses show all of an inset.
    unsafe {
        if view as usize >= EYES {
            (*mask).vertex_count_output = 0;
            (*mask).index_count_output = 0;
            return Result::SUCCESS;
        }
        next(session, below(kind), view, of, mask)
    }
}
