//! Loss of the X server. Xlib, which winit talks to it by, ends the whole program where it sees the loss first, and
//! with it the recording. It is asked to return instead; winit then fails at its next request, which is an error that
//! `application.rs` reports, after the recording has been completed.

use winit::window::Window;

/// Keeps the program alive when the X server of `window` goes. Without effect on other systems, and with libX11 before
/// 1.7, which has no such request.
pub fn outlive(window: &Window) {
    #[cfg(all(unix, not(target_os = "macos")))]
    x11::outlive(window);
    #[cfg(not(all(unix, not(target_os = "macos"))))]
    let _ = window;
}

#[cfg(all(unix, not(target_os = "macos")))]
mod x11 {
    use std::ffi::{c_int, c_void};
    use winit::raw_window_handle::{HasDisplayHandle, RawDisplayHandle};
    use winit::window::Window;

    type Report = extern "C" fn(display: *mut c_void) -> c_int;
    type SetReport = unsafe extern "C" fn(report: Report) -> *mut c_void;
    type Exit = extern "C" fn(display: *mut c_void, data: *mut c_void);
    type SetExit = unsafe extern "C" fn(display: *mut c_void, exit: Exit, data: *mut c_void);

    /// Report of the loss: the program reports it itself. Xlib's own would end the program.
    extern "C" fn say_nothing(_display: *mut c_void) -> c_int {
        0
    }

    /// End of the program after the report: Xlib returns to its caller instead.
    extern "C" fn carry_on(_display: *mut c_void, _data: *mut c_void) {}

    /// Sets both of Xlib's handlers for the display of `window`.
    pub fn outlive(window: &Window) {
        let Ok(handle) = window.display_handle() else { return };
        let RawDisplayHandle::Xlib(xlib) = handle.as_raw() else { return };
        let Some(display) = xlib.display else { return };
        // SAFETY: winit has loaded this library, so opening it again runs no code of it. The symbols, where they exist,
        // are the functions of Xlib with these signatures (Xlib.h, the second since 1.7), the display is open as long
        // as the window is, and the handlers touch nothing.
        unsafe {
            let library = libc::dlopen(c"libX11.so.6".as_ptr(), libc::RTLD_LAZY | libc::RTLD_NOLOAD);
            if library.is_null() {
                return;
            }
            let set_report = libc::dlsym(library, c"XSetIOErrorHandler".as_ptr());
            let set_exit = libc::dlsym(library, c"XSetIOErrorExitHandler".as_ptr());
            if !set_report.is_null() && !set_exit.is_null() {
                let set_report = std::mem::transmute::<*mut c_void, SetReport>(set_report);
                let set_exit = std::mem::transmute::<*mut c_void, SetExit>(set_exit);
                set_report(say_nothing);
                set_exit(display.as_ptr(), carry_on, std::ptr::null_mut());
            }
        }
    }
}
