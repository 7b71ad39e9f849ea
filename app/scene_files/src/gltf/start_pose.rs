//! Start pose: where what keys move is when the world's clock starts.

use glam::DAffine3;

use super::nodes::{NodeMotion, NodePlacement};

/// Transform from a placement's frame to the file's at time 0.
pub(super) fn at_start(placement: &NodePlacement) -> DAffine3 {
    match &placement.motion {
        Some(NodeMotion::Animated { animated, body_from_node }) => animated.at(0.0).world_from_body * *body_from_node,
        _ => placement.transform,
    }
}
