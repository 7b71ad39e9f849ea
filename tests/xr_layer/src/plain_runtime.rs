//! Runtime that can do nothing but say its name: what a program is told that needs more.

use openxr::sys::{self, Result, pfn};
use std::ffi::{CStr, c_char};
use std::path::{Path, PathBuf};

/// Name of the runtime.
pub const PLAIN_RUNTIME: &str = "Plain";

/// Declares the runtime in a folder. Returns the path for `XR_RUNTIME_JSON`.
///
/// # Panics
/// If the folder cannot be written, or the library was not built beside the test.
pub fn plain_runtime(folder: &Path) -> PathBuf {
    let manifest = format!(
        r#"{{"file_format_version": "1.0.0", "runtime": {{"name": "{PLAIN_RUNTIME}", "library_path": "{}"}}}}"#,
        crate::script::library().display()
    );
    let path = folder.join("runtime.json");
    std::fs::write(&path, manifest).expect("the folder can be written");
    path
}

/// Tells the loader where the runtime begins.
///
/// # Safety
/// Called by the loader, with structures that are whole.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn xrNegotiateLoaderRuntimeInterface(
    _loader: *const sys::NegotiateLoaderInfo,
    request: *mut sys::NegotiateRuntimeRequest,
) -> Result {
    // SAFETY: the request is the loader's, and whole.
    let request = unsafe { &mut *request };
    request.runtime_interface_version = 1;
    request.runtime_api_version = sys::Version::new(1, 0, 0);
    request.get_instance_proc_addr = Some(find);
    Result::SUCCESS
}

unsafe extern "system" fn find(
    _instance: sys::Instance,
    name: *const c_char,
    function: *mut Option<pfn::VoidFunction>,
) -> Result {
    macro_rules! own {
        ($call:ident: $kind:ident) => {
            // SAFETY: the function has the type that the standard gives the name.
            Some(unsafe { std::mem::transmute::<pfn::$kind, pfn::VoidFunction>($call) })
        };
    }
    // SAFETY: the name ends with a zero.
    let own = match unsafe { CStr::from_ptr(name) }.to_bytes() {
        b"xrGetInstanceProcAddr" => own!(find: GetInstanceProcAddr),
        b"xrEnumerateInstanceExtensionProperties" => own!(extensions: EnumerateInstanceExtensionProperties),
        b"xrCreateInstance" => own!(create: CreateInstance),
        b"xrDestroyInstance" => own!(destroy: DestroyInstance),
        b"xrGetInstanceProperties" => own!(properties: GetInstanceProperties),
        // A program looks for all functions of the standard before it calls one.
        _ => Some(never as pfn::VoidFunction),
    };
    // SAFETY: the place is the loader's.
    unsafe { *function = own };
    Result::SUCCESS
}

/// Stands for all that the runtime cannot do; a program that has been refused calls none of it.
unsafe extern "system" fn never() {
    std::process::abort();
}

unsafe extern "system" fn extensions(
    _layer: *const c_char,
    _capacity: u32,
    count: *mut u32,
    _properties: *mut sys::ExtensionProperties,
) -> Result {
    // SAFETY: the place is the loader's.
    unsafe { *count = 0 };
    Result::SUCCESS
}

unsafe extern "system" fn create(_info: *const sys::InstanceCreateInfo, instance: *mut sys::Instance) -> Result {
    // SAFETY: the place is the loader's.
    unsafe { *instance = sys::Handle::from_raw(1) };
    Result::SUCCESS
}

unsafe extern "system" fn destroy(_instance: sys::Instance) -> Result {
    Result::SUCCESS
}

unsafe extern "system" fn properties(_instance: sys::Instance, properties: *mut sys::InstanceProperties) -> Result {
    // SAFETY: the structure is the program's, and whole.
    let properties = unsafe { &mut *properties };
    properties.runtime_version = sys::Version::new(1, 0, 0);
    // A name ends with a zero.
    let letters = PLAIN_RUNTIME.bytes().chain([0]);
    properties.runtime_name.iter_mut().zip(letters).for_each(|(place, letter)| *place = letter as c_char);
    Result::SUCCESS
}
