//! Kinds of adapters whose images may be held against one another.

use realtime::AdapterInfo;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Adapters of one class make the same images up to what the gate allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AdapterClass {
    /// Mesa's software driver: the same bits on every run.
    Lavapipe,
    /// Google's software driver.
    Swiftshader,
    /// Any other software driver, such as WARP.
    OtherSoftware,
    /// A GPU.
    Hardware,
}

impl AdapterClass {
    /// The class of an adapter, by its kind and its name.
    #[must_use]
    pub fn of(adapter: &AdapterInfo) -> Self {
        let name = format!("{} {}", adapter.name, adapter.driver).to_lowercase();
        if !adapter.software {
            Self::Hardware
        } else if name.contains("llvmpipe") {
            Self::Lavapipe
        } else if name.contains("swiftshader") {
            Self::Swiftshader
        } else {
            Self::OtherSoftware
        }
    }
}

impl fmt::Display for AdapterClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lavapipe => "lavapipe",
            Self::Swiftshader => "swiftshader",
            Self::OtherSoftware => "other-software",
            Self::Hardware => "hardware",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_adapter_is_of_one_class() {
        let class = |name: &str, driver: &str, software| {
            let (name, driver) = (name.to_owned(), driver.to_owned());
            let backend = "Vulkan".to_owned();
            AdapterClass::of(&AdapterInfo { index: 0, name, backend, driver, software })
        };
        let mesa = class("llvmpipe (LLVM 15.0.6, 256 bits)", "llvmpipe Mesa 22.3.6", true);
        assert_eq!(mesa, AdapterClass::Lavapipe);
        let google = class("SwiftShader Device (LLVM 16.0.0)", "SwiftShader driver", true);
        assert_eq!(google, AdapterClass::Swiftshader);
        let microsoft = class("Microsoft Basic Render Driver", "", true);
        assert_eq!(microsoft, AdapterClass::OtherSoftware);
        assert_eq!(class("NVIDIA H100", "NVIDIA 550", false), AdapterClass::Hardware);
    }
}
