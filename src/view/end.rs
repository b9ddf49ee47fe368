//! Why drawing ends before its time.

use crate::setup::SetupError;

/// Why drawing ends before its time.
pub(super) enum End {
    /// A newer order has come, or the end.
    Superseded,
    /// The scene cannot be drawn.
    Refused(SetupError),
}

impl From<SetupError> for End {
    fn from(error: SetupError) -> Self {
        Self::Refused(error)
    }
}
