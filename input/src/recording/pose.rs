//! Poses in the form of Foxglove's schemas, so that 3D views show the ride. No replay reads them.
//!
//! A pose is that of the observer, in the world's axes (y up). One transform at the beginning turns the world into a
//! frame whose z is up, as such views expect it.

use serde::Serialize;

use super::record::FrameRecord;

/// Name and schema of the channel with the observer's poses, one a frame.
pub(super) const POSE_TOPIC: &str = "/pose";
pub(super) const POSE_SCHEMA: (&str, &str) = ("foxglove.PoseInFrame", include_str!("pose.schema.json"));
/// Name and schema of the channel with the transform of the world.
pub(super) const TRANSFORM_TOPIC: &str = "/tf";
pub(super) const TRANSFORM_SCHEMA: (&str, &str) = ("foxglove.FrameTransform", include_str!("transform.schema.json"));

/// Frame of reference in which poses are given: the scene's axes, y up.
const WORLD: &str = "world";
/// Frame of reference that has the same origin and z up.
const MAP: &str = "map";

const NANOS_PER_SECOND: u64 = 1_000_000_000;

/// Time since 1970, in Foxglove's form.
#[derive(Clone, Copy, Debug, Serialize)]
struct PoseTime {
    sec: u64,
    nsec: u64,
}

impl PoseTime {
    fn new(unix_ns: u64) -> Self {
        Self { sec: unix_ns / NANOS_PER_SECOND, nsec: unix_ns % NANOS_PER_SECOND }
    }
}

/// Point or translation, metres.
#[derive(Clone, Copy, Debug, Serialize)]
struct PosePoint {
    x: f64,
    y: f64,
    z: f64,
}

impl From<[f64; 3]> for PosePoint {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

/// Rotation as a quaternion.
#[derive(Clone, Copy, Debug, Serialize)]
struct PoseTurn {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

impl From<[f64; 4]> for PoseTurn {
    fn from([x, y, z, w]: [f64; 4]) -> Self {
        Self { x, y, z, w }
    }
}

/// Place and orientation.
#[derive(Clone, Copy, Debug, Serialize)]
struct PlaceAndTurn {
    position: PosePoint,
    orientation: PoseTurn,
}

/// Pose of the observer in the world, as `foxglove.PoseInFrame`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct PoseInFrame {
    timestamp: PoseTime,
    frame_id: &'static str,
    pose: PlaceAndTurn,
}

impl PoseInFrame {
    /// Pose of a frame at a time since 1970, nanoseconds.
    pub(super) fn new(unix_ns: u64, record: &FrameRecord) -> Self {
        let pose = PlaceAndTurn { position: record.position.into(), orientation: record.orientation.into() };
        Self { timestamp: PoseTime::new(unix_ns), frame_id: WORLD, pose }
    }
}

/// Transform of the world into a frame with z up, as `foxglove.FrameTransform`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct FrameTransform {
    timestamp: PoseTime,
    parent_frame_id: &'static str,
    child_frame_id: &'static str,
    translation: PosePoint,
    rotation: PoseTurn,
}

impl FrameTransform {
    /// Transform from a time since 1970 on, nanoseconds: a quarter turn about x.
    pub(super) fn new(unix_ns: u64) -> Self {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        Self {
            timestamp: PoseTime::new(unix_ns),
            parent_frame_id: MAP,
            child_frame_id: WORLD,
            translation: [0.0; 3].into(),
            rotation: [half, 0.0, 0.0, half].into(),
        }
    }
}

#[cfg(test)]
mod tests {
    //! A view reads the fields that the schema names, and nothing else.
    use super::*;
    use serde_json::Value;

    fn keys(value: &Value) -> Vec<String> {
        value.as_object().unwrap().keys().cloned().collect()
    }

    #[test]
    fn schemas_describe_exactly_what_is_written() {
        let record = FrameRecord { position: [1.0, 2.0, 3.0], orientation: [0.0, 0.6, 0.0, 0.8], ..Default::default() };
        let pose = serde_json::to_value(PoseInFrame::new(7_000_000_009, &record)).unwrap();
        let transform = serde_json::to_value(FrameTransform::new(0)).unwrap();
        for ((_, schema), written) in [(POSE_SCHEMA, &pose), (TRANSFORM_SCHEMA, &transform)] {
            let schema: Value = serde_json::from_str(schema).unwrap();
            assert_eq!(keys(&schema["properties"]), keys(written));
            for (key, described) in schema["properties"].as_object().unwrap() {
                if described.get("properties").is_some() {
                    assert_eq!(keys(&described["properties"]), keys(&written[key]), "{key}");
                }
            }
        }
        assert_eq!(pose["timestamp"], serde_json::json!({"sec": 7, "nsec": 9}));
        assert_eq!(pose["pose"]["position"], serde_json::json!({"x": 1.0, "y": 2.0, "z": 3.0}));
    }

    #[test]
    fn up_in_the_world_is_up_in_the_map() {
        let PoseTurn { x, y, z, w } = FrameTransform::new(0).rotation;
        let up = glam::DQuat::from_xyzw(x, y, z, w) * glam::DVec3::Y;
        assert!((up - glam::DVec3::Z).length() < 1e-15, "{up}");
    }
}
