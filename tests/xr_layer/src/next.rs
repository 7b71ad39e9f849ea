//! Functions of the next layer, or of the runtime.

use openxr::sys::{Instance, pfn};
use std::ffi::CString;

/// Declares the functions that are passed on to.
macro_rules! functions {
    ($($field:ident: $kind:ident = $name:literal,)*) => {
        /// Functions of the next layer, or of the runtime.
        #[derive(Clone, Copy)]
        pub(crate) struct NextFunctions {
            /// Function that finds all others.
            pub(crate) find: pfn::GetInstanceProcAddr,
            $(pub(crate) $field: pfn::$kind,)*
            /// Function of an extension that the program may not have asked for.
            pub(crate) visibility_mask: Option<pfn::GetVisibilityMaskKHR>,
        }

        impl NextFunctions {
            /// Functions of an instance; `None` if one is missing.
            ///
            /// # Safety
            /// `find` belongs to the instance, which is alive.
            pub(crate) unsafe fn of(find: pfn::GetInstanceProcAddr, instance: Instance) -> Option<Self> {
                // SAFETY: the instance is alive, as the caller promises; the function of that name has that type.
                let visibility_mask = unsafe {
                    found(find, instance, "xrGetVisibilityMaskKHR")
                        .map(|function| std::mem::transmute::<pfn::VoidFunction, pfn::GetVisibilityMaskKHR>(function))
                };
                Some(Self {
                    find,
                    visibility_mask,
                    $($field: {
                        // SAFETY: the instance is alive, as the caller promises.
                        let function = unsafe { found(find, instance, $name) }?;
                        // SAFETY: the function of that name has that type, by the standard.
                        unsafe { std::mem::transmute::<pfn::VoidFunction, pfn::$kind>(function) }
                    },)*
                })
            }
        }
    };
}

functions! {
    poll_event: PollEvent = "xrPollEvent",
    enumerate_view_configurations: EnumerateViewConfigurations = "xrEnumerateViewConfigurations",
    enumerate_views: EnumerateViewConfigurationViews = "xrEnumerateViewConfigurationViews",
    enumerate_blend_modes: EnumerateEnvironmentBlendModes = "xrEnumerateEnvironmentBlendModes",
    begin_session: BeginSession = "xrBeginSession",
    end_session: EndSession = "xrEndSession",
    wait_frame: WaitFrame = "xrWaitFrame",
    begin_frame: BeginFrame = "xrBeginFrame",
    end_frame: EndFrame = "xrEndFrame",
    create_reference_space: CreateReferenceSpace = "xrCreateReferenceSpace",
    create_action_space: CreateActionSpace = "xrCreateActionSpace",
    locate_space: LocateSpace = "xrLocateSpace",
    locate_views: LocateViews = "xrLocateViews",
    create_action: CreateAction = "xrCreateAction",
    string_to_path: StringToPath = "xrStringToPath",
    sync_actions: SyncActions = "xrSyncActions",
    get_boolean: GetActionStateBoolean = "xrGetActionStateBoolean",
    get_float: GetActionStateFloat = "xrGetActionStateFloat",
    get_vector: GetActionStateVector2f = "xrGetActionStateVector2f",
}

/// Function of a name.
///
/// # Safety
/// `find` belongs to the instance, which is alive.
unsafe fn found(find: pfn::GetInstanceProcAddr, instance: Instance, name: &str) -> Option<pfn::VoidFunction> {
    let name = CString::new(name).ok()?;
    let mut function = None;
    // SAFETY: the name ends with a zero, and the place outlives the call.
    let result = unsafe { find(instance, name.as_ptr(), &raw mut function) };
    function.filter(|_| result.into_raw() >= 0)
}
