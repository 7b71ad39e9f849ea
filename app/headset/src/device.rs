//! Graphics device of a headset: made by its runtime with what wgpu needs, so that both can use it.

use crate::error::HeadsetError;
use ash::vk;
use ash::vk::Handle;
use input::openxr::XrRuntime;
use openxr as xr;
use render::Gpu;
use std::ffi::{CStr, c_char};
use wgpu::hal;
use wgpu::hal::api::Vulkan;

/// Version of Vulkan that is asked for. wgpu submits by calls of 1.2.
const VERSION: u32 = vk::API_VERSION_1_3;
/// Family and number of the queue that runtime and renderers share.
const QUEUE: (u32, u32) = (0, 0);

/// Graphics device of a headset.
pub struct HeadsetDevice {
    /// Device for the renderers.
    pub gpu: Gpu,
    /// Handles of the same device for the runtime.
    pub(crate) handles: xr::vulkan::SessionCreateInfo,
}

impl HeadsetDevice {
    /// Opens the device that the runtime wants.
    ///
    /// # Errors
    /// A runtime that refuses, or a driver without what wgpu needs.
    pub fn open(runtime: &XrRuntime) -> Result<Self, HeadsetError> {
        let failed = |error: &dyn std::fmt::Display| HeadsetError::Device(error.to_string());
        let refused = runtime.refused("a graphics device");
        let XrRuntime { instance: xr_instance, system, .. } = runtime;
        // The runtime demands this question before all others.
        xr_instance.graphics_requirements::<xr::Vulkan>(*system).map_err(&refused)?;

        // SAFETY: the loader is the system's own library of that name.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| failed(&error))?;
        let flags = wgpu::InstanceFlags::empty();
        let extensions =
            hal::vulkan::Instance::desired_extensions(&entry, VERSION, flags).map_err(|error| failed(&error))?;
        let application = vk::ApplicationInfo::default().api_version(VERSION);
        let names = pointers(&extensions);
        let info = vk::InstanceCreateInfo::default().application_info(&application).enabled_extension_names(&names);
        // SAFETY: the function is that of the loaded library; both crates declare it with the same C signature.
        let get: xr::sys::platform::VkGetInstanceProcAddr =
            unsafe { std::mem::transmute(entry.static_fn().get_instance_proc_addr) };
        // SAFETY: `info` and all that it points to live beyond the call.
        let made = unsafe { xr_instance.create_vulkan_instance(*system, get, (&raw const info).cast()) };
        let raw_instance = made.map_err(&refused)?.map_err(|code| failed(&vk::Result::from_raw(code)))?;
        // SAFETY: the handle is that of the instance just made.
        let physical = unsafe { xr_instance.vulkan_graphics_device(*system, raw_instance) }.map_err(&refused)?;
        let vk_instance = vk::Instance::from_raw(raw_instance as u64);
        let vk_physical = vk::PhysicalDevice::from_raw(physical as u64);
        // SAFETY: the handle belongs to `entry`'s library.
        let instance = unsafe { ash::Instance::load(entry.static_fn(), vk_instance) };
        // SAFETY: the instance was made from `entry` with this version and these extensions; wgpu owns it from now on.
        let hal_instance = unsafe {
            hal::vulkan::Instance::from_raw(
                entry,
                instance.clone(),
                VERSION,
                0,
                None,
                extensions,
                flags,
                wgpu::MemoryBudgetThresholds::default(),
                false,
                None,
            )
        }
        .map_err(|error| failed(&error))?;
        let exposed = hal_instance.expose_adapter(vk_physical).ok_or_else(|| failed(&"wgpu cannot use it"))?;

        let features = exposed.features & Gpu::WANTED.union(wgpu::Features::MULTIVIEW);
        let limits = exposed.capabilities.limits.clone();
        let extensions = exposed.adapter.required_device_extensions(features);
        let mut wanted = exposed.adapter.physical_device_features(&extensions, features);
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(QUEUE.0).queue_priorities(&[1.0])];
        let names = pointers(&extensions);
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).enabled_extension_names(&names);
        let info = wanted.add_to_device_create(info);
        // SAFETY: `info` and all that it points to live beyond the call.
        let made = unsafe { xr_instance.create_vulkan_device(*system, get, physical, (&raw const info).cast()) };
        let raw_device = made.map_err(&refused)?.map_err(|code| failed(&vk::Result::from_raw(code)))?;
        // SAFETY: the handle is that of the device just made from this instance.
        let device = unsafe { ash::Device::load(instance.fp_v1_0(), vk::Device::from_raw(raw_device as u64)) };
        // SAFETY: the device has this queue, these extensions and features; wgpu owns it from now on.
        let open = unsafe {
            exposed.adapter.device_from_raw(
                device,
                None,
                &extensions,
                features,
                &limits,
                &wgpu::MemoryHints::default(),
                QUEUE.0,
                QUEUE.1,
            )
        }
        .map_err(|error| failed(&error))?;

        // SAFETY: the parts belong together, as above.
        let (instance, adapter) = unsafe {
            let instance = wgpu::Instance::from_hal::<Vulkan>(hal_instance);
            let adapter = instance.create_adapter_from_hal(exposed);
            (instance, adapter)
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("headset"),
            required_features: features,
            required_limits: limits,
            ..Default::default()
        };
        // SAFETY: the device was opened from this adapter, with these features.
        let (device, queue) =
            unsafe { adapter.create_device_from_hal(open, &descriptor) }.map_err(|error| failed(&error))?;
        let handles = xr::vulkan::SessionCreateInfo {
            instance: raw_instance,
            physical_device: physical,
            device: raw_device,
            queue_family_index: QUEUE.0,
            queue_index: QUEUE.1,
        };
        Ok(Self { gpu: Gpu::of(instance, adapter, device, queue), handles })
    }
}

fn pointers(names: &[&CStr]) -> Vec<*const c_char> {
    names.iter().map(|name| name.as_ptr()).collect()
}
