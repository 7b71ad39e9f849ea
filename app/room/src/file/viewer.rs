//! `[viewer]` table: the distance between the eyes, the place of an untracked head, and what its turn does.

use super::schema;
use super::text::DisplayText;
use crate::error::DisplayError;
use crate::viewer::Viewer;
use glam::DVec3;
use toml::Spanned;

/// Viewer of the table, or the usual viewer if there is none.
pub(super) fn resolve(
    text: &DisplayText<'_>,
    table: Option<&Spanned<schema::ViewerTable>>,
) -> Result<Viewer, DisplayError> {
    let mut viewer = Viewer::default();
    let Some(table) = table else { return Ok(viewer) };
    let refuse = |key: &str, reason: &str| {
        Err(DisplayError::Value { at: text.at(table.span().start, "viewer", key), reason: reason.into() })
    };
    let given = table.get_ref();
    if let Some(separation) = given.eye_separation {
        if !(0.0..=1.0).contains(&separation) {
            return refuse(
                "eye_separation",
                &format!("{separation} m is no distance between eyes; people have 0.05 to 0.08"),
            );
        }
        viewer.eye_separation_m = separation;
    }
    if let Some(scale) = given.eye_scale {
        if !(scale.is_finite() && scale >= 0.0) {
            return refuse("eye_scale", &format!("{scale} is no scale; 1 is true, 0 takes the depth away"));
        }
        viewer.eye_scale = scale;
    }
    if let Some(head) = given.head.map(DVec3::from) {
        if !head.is_finite() {
            return refuse("head", "a coordinate is not a finite number");
        }
        viewer.head_m = head;
    }
    viewer.turns_pictures = given.turns_pictures.unwrap_or(viewer.turns_pictures);
    Ok(viewer)
}
