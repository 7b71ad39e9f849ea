//! The graphics device: found once, shared by every renderer and window.
//!
//! Vulkan on Linux, in hardware or in software (lavapipe). If no driver is found, [`GpuError::NoAdapter`] names the
//! package to install. A device can be lost at any time (a driver reset, a pulled eGPU). [`Gpu::lost`] then returns
//! an error, and the caller ends its work in good order: a recording or a film is completed.

use std::sync::{Arc, Mutex, PoisonError};
use thiserror::Error;

/// Reason for which no picture can be drawn.
#[derive(Debug, Error)]
pub enum GpuError {
    /// A missing driver or loader.
    #[error(
        "no Vulkan driver was found ({0}); on Debian or Ubuntu install libvulkan1 and mesa-vulkan-drivers \
         (`sudo apt-get install libvulkan1 mesa-vulkan-drivers`), or your graphics card's own driver"
    )]
    NoAdapter(String),
    /// A device that the driver refused to open.
    #[error("the graphics device {adapter} could not be opened: {reason}")]
    NoDevice {
        /// Name of the device, from the driver.
        adapter: String,
        /// Reason given by the driver.
        reason: String,
    },
    /// A command that the driver refused.
    #[error("the graphics device refused to draw: {0}; a smaller --size or a longer --edge may help")]
    Refused(String),
    /// A driver that went away or failed while drawing.
    #[error("the graphics device was lost: {0}; restart the program, and update the driver if it happens again")]
    Lost(String),
}

/// An open device and its queue.
pub struct Gpu {
    /// Instance that makes the surfaces of windows.
    pub instance: wgpu::Instance,
    /// Adapter that was chosen.
    pub adapter: wgpu::Adapter,
    /// Logical device, which makes resources.
    pub device: wgpu::Device,
    /// Queue of the device, which takes the work.
    pub queue: wgpu::Queue,
    fault: Arc<Mutex<Option<Fault>>>,
}

impl Gpu {
    /// Features that are used where a device has them.
    pub const WANTED: wgpu::Features = wgpu::Features::FLOAT32_BLENDABLE.union(wgpu::Features::FLOAT32_FILTERABLE);

    /// Opens the best device there is, for drawing without a window.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if there is no driver, [`GpuError::NoDevice`] if the device does not open.
    pub fn new() -> Result<Self, GpuError> {
        Self::with_instance(wgpu::Instance::new(descriptor()), None)
    }

    /// Opens the best device that can draw into `surface`, made from `instance`.
    ///
    /// # Errors
    /// Those of [`Gpu::new`].
    pub fn with_instance(instance: wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Result<Self, GpuError> {
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: surface,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|error| GpuError::NoAdapter(error.to_string()))?;
        let device_descriptor = wgpu::DeviceDescriptor {
            label: Some("rapidity"),
            required_features: adapter.features() & Self::WANTED,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor))
            .map_err(|error| GpuError::NoDevice { adapter: adapter.get_info().name, reason: error.to_string() })?;
        Ok(Self::of(instance, adapter, device, queue))
    }

    /// Device that has been opened elsewhere.
    pub fn of(instance: wgpu::Instance, adapter: wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let fault = Arc::new(Mutex::new(None));
        let (on_loss, on_error) = (Arc::clone(&fault), Arc::clone(&fault));
        device.set_device_lost_callback(move |reason, message| {
            note(&on_loss, Fault::Lost(format!("{reason:?}: {message}")));
        });
        device
            .on_uncaptured_error(Arc::new(move |error| note(&on_error, Fault::Refused(one_line(&error.to_string())))));
        Self { instance, adapter, device, queue, fault }
    }

    /// Name and driver of the adapter, for the HUD and for reports.
    pub fn description(&self) -> String {
        let info = self.adapter.get_info();
        format!("{} ({:?}, {})", info.name, info.backend, info.driver_info)
    }

    /// True if drawing happens on the CPU.
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }

    /// True if the device can blend into and filter colour targets of 32-bit floats.
    pub fn has_full_precision(&self) -> bool {
        self.device.features().contains(wgpu::Features::FLOAT32_BLENDABLE | wgpu::Features::FLOAT32_FILTERABLE)
    }

    /// Returns the first fault that the driver reported, if any.
    ///
    /// # Errors
    /// [`GpuError::Lost`] or [`GpuError::Refused`] with the driver's words.
    pub fn lost(&self) -> Result<(), GpuError> {
        match &*self.fault.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(Fault::Lost(message)) => Err(GpuError::Lost(message.clone())),
            Some(Fault::Refused(message)) => Err(GpuError::Refused(message.clone())),
            None => Ok(()),
        }
    }

    /// Waits until everything submitted so far is done.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away meanwhile.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.poll(wgpu::PollType::wait_indefinitely())
    }

    /// Waits until a submission is done, and those before it.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away meanwhile.
    pub fn wait_for(&self, submission: wgpu::SubmissionIndex) -> Result<(), GpuError> {
        self.poll(wgpu::PollType::Wait { submission_index: Some(submission), timeout: None })
    }

    fn poll(&self, until: wgpu::PollType) -> Result<(), GpuError> {
        self.device.poll(until).map_err(|error| GpuError::Lost(error.to_string()))?;
        self.lost()
    }
}

/// Instance descriptor: Vulkan, or another API of the system; the environment variable `WGPU_BACKEND` overrides it.
pub fn descriptor() -> wgpu::InstanceDescriptor {
    wgpu::InstanceDescriptor::new_without_display_handle_from_env()
}

/// A fault that the driver reported, with its message.
enum Fault {
    Lost(String),
    Refused(String),
}

/// Keeps the first fault only. Later faults are consequences of it.
fn note(fault: &Mutex<Option<Fault>>, news: Fault) {
    fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(news);
}

/// A report of several lines, joined into one line.
fn one_line(report: &str) -> String {
    report.split_whitespace().collect::<Vec<_>>().join(" ")
}
