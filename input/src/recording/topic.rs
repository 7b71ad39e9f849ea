//! Channels of a recording, with their schemas.

/// Channel of the recording that a replay needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RecordingTopic {
    Samples,
    Controls,
    Frames,
}

/// Message encoding of texts, and the encoding of their schemas.
pub(super) const JSON: &str = "json";
pub(super) const JSON_SCHEMA: &str = "jsonschema";
/// Message encoding of samples, whose bytes stay bytes. CBOR describes itself, so it has no schema.
pub(super) const CBOR: &str = "cbor";

impl RecordingTopic {
    pub(super) const ALL: [Self; 3] = [Self::Samples, Self::Controls, Self::Frames];

    /// Name of the channel in the file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Samples => "/device/raw",
            Self::Controls => "/controls",
            Self::Frames => "/observer",
        }
    }

    /// Encoding of the channel's messages, as they are written.
    pub(super) fn encoding(self) -> &'static str {
        match self {
            Self::Samples => CBOR,
            Self::Controls | Self::Frames => JSON,
        }
    }

    /// Name and text of the channel's schema, if it has one.
    pub(super) fn schema(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Samples => None,
            Self::Controls => Some(("rapidity.Controls", include_str!("controls.schema.json"))),
            Self::Frames => Some(("rapidity.Observer", include_str!("observer.schema.json"))),
        }
    }
}
