//! The name of a result: a hash of everything that it depends on.

use serde::Serialize;
use sha2::{Digest, Sha256};
use std::fmt;

/// Number of the form in which results are stored; a new form, a new number.
pub const FORMAT: u32 = 1;

/// Content id: a job is the same job exactly if its id is the same.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(String);

impl Id {
    /// Hash of a description and of [`FORMAT`].
    ///
    /// # Panics
    /// If the description cannot be written as JSON: our mistake.
    #[must_use]
    pub fn of(description: &impl Serialize) -> Self {
        #[expect(clippy::unwrap_used, reason = "descriptions are plain structs with string keys")]
        let text = serde_json::to_string(description).unwrap();
        let mut hash = Sha256::new();
        hash.update(FORMAT.to_le_bytes());
        hash.update(text);
        Self(hex(&hash.finalize())[..32].to_owned())
    }

    /// An id that was written down before.
    #[must_use]
    pub(crate) fn known(text: &str) -> Self {
        Self(text.to_owned())
    }

    /// 32 hexadecimal digits.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Lower-case hexadecimal digits.
pub(in crate::study) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
