//! Adapters and devices: finding one, opening it, and saying which it is.

pub(crate) mod allocator;
pub(crate) mod environment_upload;
pub(crate) mod limits;
pub(crate) mod readback;
pub(crate) mod recorder;
pub(crate) mod resources;

use crate::error::Error;
use serde::{Deserialize, Serialize};
use std::future::Future;
use std::pin::pin;
use std::sync::{Arc, OnceLock};
use std::task::{Context, Poll, Waker};

/// One adapter as wgpu lists it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdapterInfo {
    /// Position in the list; what `--adapter` takes.
    pub index: usize,
    /// The driver's name for it.
    pub name: String,
    /// Vulkan, Metal, Dx12.
    pub backend: String,
    /// Driver and version.
    pub driver: String,
    /// True when the adapter is a CPU in disguise.
    pub software: bool,
}

/// An opened adapter.
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) timestamps: bool,
    info: AdapterInfo,
    lost: Arc<OnceLock<String>>,
}

/// An environment variable that keeps a driver from writing to standard error,
/// and its value, where one is needed and not set; to be set before this process
/// starts.
///
/// Mesa's layer that sorts devices asks the Wayland server for its own, and says
/// "error: XDG_RUNTIME_DIR is invalid or not set" where no desktop session is.
/// There it has nothing to sort by, unless it is told a device by name.
#[must_use]
pub fn noise() -> Option<(&'static str, &'static str)> {
    let is_set = |name| std::env::var_os(name).is_some();
    let asked = ["NODEVICE_SELECT", "XDG_RUNTIME_DIR", "MESA_VK_DEVICE_SELECT"];
    (cfg!(target_os = "linux") && !asked.into_iter().any(is_set))
        .then_some(("NODEVICE_SELECT", "1"))
}

/// What can be used here, in wgpu's order.
#[must_use]
pub fn adapters() -> Vec<AdapterInfo> {
    enumerate().iter().enumerate().map(|(index, adapter)| describe(index, adapter)).collect()
}

impl Gpu {
    /// Opens an adapter by number, by a part of its name, or the first hardware
    /// one (the first of all if there is no hardware).
    ///
    /// # Errors
    /// If there is no such adapter or it does not open.
    pub fn open(choice: Option<&str>) -> Result<Self, Error> {
        let found = enumerate();
        let infos: Vec<_> = found.iter().enumerate().map(|(i, a)| describe(i, a)).collect();
        let chosen = match choice {
            None => infos.iter().find(|info| !info.software).or(infos.first()),
            Some(wanted) => infos.iter().find(|info| {
                wanted.parse() == Ok(info.index)
                    || info.name.to_lowercase().contains(&wanted.to_lowercase())
            }),
        };
        let info = match (chosen, choice) {
            (Some(info), _) => info.clone(),
            (None, Some(wanted)) if !infos.is_empty() => {
                let names: Vec<_> =
                    infos.iter().map(|i| format!("{} {}", i.index, i.name)).collect();
                return Err(Error::UnknownAdapter {
                    wanted: wanted.to_owned(),
                    available: names.join(", "),
                });
            }
            (None, _) => return Err(Error::NoAdapter),
        };
        Self::open_adapter(&found[info.index], info)
    }

    fn open_adapter(adapter: &wgpu::Adapter, info: AdapterInfo) -> Result<Self, Error> {
        let wanted = wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::FLOAT32_FILTERABLE
            | wgpu::Features::FLOAT32_BLENDABLE
            | wgpu::Features::SHADER_INT64
            | wgpu::Features::SHADER_INT64_ATOMIC_ALL_OPS;
        let features = adapter.features() & wanted;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("snell"),
            required_features: features,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = block_on(adapter.request_device(&descriptor)).map_err(|error| {
            Error::Open { adapter: info.name.clone(), reason: error.to_string() }
        })?;
        let timestamps = features.contains(wgpu::Features::TIMESTAMP_QUERY);
        let lost = Arc::new(OnceLock::new());
        let seen = Arc::clone(&lost);
        device.set_device_lost_callback(move |reason, message| {
            // Only the first reason matters.
            let _ = seen.set(format!("{reason:?} {message}"));
        });
        Ok(Self { device, queue, timestamps, info, lost })
    }

    /// Which adapter this is.
    #[must_use]
    pub fn info(&self) -> &AdapterInfo {
        &self.info
    }

    /// Runs `work` and turns any error the driver reports into ours.
    pub(crate) fn scoped<T>(&self, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let result = work();
        let reported = [memory, validation, internal].map(|scope| block_on(scope.pop()));
        let adapter = self.info.name.clone();
        if let Some(reason) = self.lost.get() {
            return Err(Error::Lost { adapter, reason: reason.clone() });
        }
        match reported.into_iter().flatten().next() {
            Some(wgpu::Error::OutOfMemory { .. }) => Err(Error::OutOfMemory { adapter }),
            Some(error) => Err(self.failed(&error)),
            None => result,
        }
    }

    /// Waits until the GPU has nothing left to do.
    pub(crate) fn wait(&self) -> Result<(), Error> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        if let Some(reason) = self.lost.get() {
            let (adapter, reason) = (self.info.name.clone(), reason.clone());
            return Err(Error::Lost { adapter, reason });
        }
        waited.map(|_| ()).map_err(|error| self.failed(&error))
    }

    pub(crate) fn failed(&self, error: &dyn std::fmt::Display) -> Error {
        Error::Device { adapter: self.info.name.clone(), what: error.to_string() }
    }
}

fn enumerate() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
}

fn describe(index: usize, adapter: &wgpu::Adapter) -> AdapterInfo {
    let info = adapter.get_info();
    AdapterInfo {
        index,
        name: info.name,
        backend: format!("{:?}", info.backend),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        software: info.device_type == wgpu::DeviceType::Cpu,
    }
}

/// wgpu's native futures are ready when polled or become so without a reactor.
pub(crate) fn block_on<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        if let Poll::Ready(value) = future.as_mut().poll(&mut context) {
            return value;
        }
        std::thread::yield_now();
    }
}
