//! Answers: JSON objects of finite numbers.

use glam::{DQuat, DVec3};
use physics::{Event, FourVector};
use serde_json::{Map, Value};

use crate::error::ProbeError;

/// An answer that is filled key by key. A number that is not finite has no JSON form and is an error.
#[derive(Debug, Default)]
pub(super) struct AnswerObject(Map<String, Value>);

impl AnswerObject {
    pub(super) fn number(self, key: &'static str, number: f64) -> Result<Self, ProbeError> {
        finite(key, &[number])?;
        Ok(self.with(key, number.into()))
    }

    pub(super) fn vector(self, key: &'static str, vector: DVec3) -> Result<Self, ProbeError> {
        self.list(key, &vector.to_array())
    }

    /// Adds a four-vector, as [t, x, y, z].
    pub(super) fn four_vector(self, key: &'static str, vector: FourVector) -> Result<Self, ProbeError> {
        let FourVector { t, r } = vector;
        self.list(key, &[t, r.x, r.y, r.z])
    }

    /// Adds a quaternion, as [x, y, z, w].
    pub(super) fn quaternion(self, key: &'static str, quaternion: DQuat) -> Result<Self, ProbeError> {
        self.list(key, &quaternion.to_array())
    }

    /// Adds an event, as an object of `position` and `time`.
    pub(super) fn event(self, key: &'static str, event: Event) -> Result<Self, ProbeError> {
        let object = Self::default().vector("position", event.position)?.number("time", event.ct)?;
        Ok(self.with(key, object.finish()))
    }

    pub(super) fn finish(self) -> Value {
        Value::Object(self.0)
    }

    fn list(self, key: &'static str, numbers: &[f64]) -> Result<Self, ProbeError> {
        finite(key, numbers)?;
        Ok(self.with(key, numbers.into()))
    }

    fn with(mut self, key: &'static str, value: Value) -> Self {
        self.0.insert(key.to_owned(), value);
        self
    }
}

fn finite(key: &'static str, numbers: &[f64]) -> Result<(), ProbeError> {
    if numbers.iter().all(|number| number.is_finite()) { Ok(()) } else { Err(ProbeError::NotFinite { key }) }
}
