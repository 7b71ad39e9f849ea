//! `[[screen]]` tables: the form in which a screen is written, and the surface that it describes.

use super::text::DisplayText;
use super::{names, schema};
use crate::display::Screen;
use crate::error::{DisplayError, FilePlace};
use crate::reflection::Reflection;
use crate::surface::cylinder::CylinderSurface;
use crate::surface::flat::FlatSurface;
use crate::surface::mesh_file;
use crate::surface::shape::ScreenSurface;
use crate::surface::sphere::SphereSurface;
use crate::surface::sweep::sweep;
use glam::{DVec2, DVec3};
use regular_file::Budget;
use std::path::Path;
use toml::Spanned;

/// Screens of all `[[screen]]` tables, in the file's order.
pub(super) fn resolve(
    text: &DisplayText<'_>,
    tables: &[Spanned<schema::ScreenTable>],
    folder: &Path,
    budget: &Budget,
) -> Result<Vec<Screen>, DisplayError> {
    names::check(text, "screen", tables, |screen| &screen.name)?;
    tables
        .iter()
        .map(|table| {
            let form = ScreenForm { text, start: table.span().start, given: table.get_ref(), folder, budget };
            Ok(Screen { name: form.given.name.clone(), surface: form.surface()?, reflection: form.reflection()? })
        })
        .collect()
}

/// One `[[screen]]` table, and the byte of the text where it begins.
struct ScreenForm<'a> {
    text: &'a DisplayText<'a>,
    start: usize,
    given: &'a schema::ScreenTable,
    folder: &'a Path,
    budget: &'a Budget,
}

impl ScreenForm<'_> {
    fn at(&self, key: &str) -> Box<FilePlace> {
        self.text.at(self.start, &format!("screen {:?}", self.given.name), key)
    }

    fn refuse<T>(&self, key: &str, reason: impl Into<String>) -> Result<T, DisplayError> {
        Err(DisplayError::Value { at: self.at(key), reason: reason.into() })
    }

    fn surface(&self) -> Result<ScreenSurface, DisplayError> {
        self.finite()?;
        let given = self.given;
        let corners = [given.lower_left, given.lower_right, given.upper_left, given.upper_right];
        let has_corners = corners.iter().any(Option::is_some);
        let has_centre = given.centre.is_some()
            || given.size.is_some()
            || [given.yaw, given.pitch, given.roll].iter().any(Option::is_some);
        let forms = [
            has_corners,
            has_centre,
            given.cylinder.is_some(),
            given.sphere.is_some(),
            given.sweep.is_some(),
            given.mesh.is_some(),
        ];
        const FORMS: &str = "three corners, or a centre and a size, or one of cylinder, sphere, sweep, mesh";
        match forms.iter().filter(|form| **form).count() {
            0 => return self.refuse("", format!("it says nowhere where it is; write {FORMS}")),
            1 => {}
            _ => return self.refuse("", format!("it says more than once where it is; write only {FORMS}")),
        }
        if has_corners {
            self.corners()
        } else if has_centre {
            self.centre()
        } else if let Some(cylinder) = &given.cylinder {
            self.cylinder(cylinder)
        } else if let Some(sphere) = &given.sphere {
            self.sphere(sphere)
        } else if let Some(sweep) = &given.sweep {
            self.sweep(sweep)
        } else {
            let path = self.folder.join(given.mesh.as_deref().unwrap_or_default());
            mesh_file::load(&path, self.budget)
                .map(|mesh| ScreenSurface::Mesh(Box::new(mesh)))
                .map_err(|reason| DisplayError::Import { path, reason })
        }
    }

    /// Checks that every number of the table is finite.
    fn finite(&self) -> Result<(), DisplayError> {
        let given = self.given;
        let points = [
            ("lower_left", given.lower_left),
            ("lower_right", given.lower_right),
            ("upper_left", given.upper_left),
            ("upper_right", given.upper_right),
            ("centre", given.centre),
            ("size", given.size.map(|[width, height]| [width, height, 0.0])),
            ("yaw", given.yaw.map(|angle| [angle, 0.0, 0.0])),
            ("pitch", given.pitch.map(|angle| [angle, 0.0, 0.0])),
            ("roll", given.roll.map(|angle| [angle, 0.0, 0.0])),
        ];
        let mut numbers: Vec<(&str, f64)> =
            points.iter().flat_map(|(key, point)| point.iter().flatten().map(|&number| (*key, number))).collect();
        if let Some(cylinder) = &given.cylinder {
            let schema::CylinderTable { centre, radius, left, right, bottom, top } = cylinder;
            numbers.extend([radius, left, right, bottom, top].map(|&number| ("cylinder", number)));
            numbers.extend(centre.map(|number| ("cylinder", number)));
        }
        if let Some(sphere) = &given.sphere {
            let schema::SphereTable { centre, radius, left, right, bottom, top } = sphere;
            numbers.extend([left, right, bottom, top].iter().filter_map(|number| Some(("sphere", (**number)?))));
            numbers.extend(centre.iter().chain([radius]).map(|&number| ("sphere", number)));
        }
        if let Some(sweep) = &given.sweep {
            let ends = [sweep.width, sweep.bend.unwrap_or(0.0)];
            let all = ends.iter().chain(&sweep.centre).chain(sweep.profile.iter().flatten());
            numbers.extend(all.map(|&number| ("sweep", number)));
        }
        if let Some((key, number)) = numbers.iter().find(|(_, number)| !number.is_finite()) {
            return self.refuse(key, format!("{number} is not a finite number"));
        }
        Ok(())
    }

    fn corners(&self) -> Result<ScreenSurface, DisplayError> {
        let given = self.given;
        let [ll, lr, ul, ur] = [given.lower_left, given.lower_right, given.upper_left, given.upper_right]
            .map(|corner| corner.map(DVec3::from));
        // Any three corners determine the fourth.
        let (ll, lr, ul) = match (ll, lr, ul, ur) {
            (Some(ll), Some(lr), Some(ul), _) => (ll, lr, ul),
            (Some(ll), Some(lr), None, Some(ur)) => (ll, lr, ll + ur - lr),
            (Some(ll), None, Some(ul), Some(ur)) => (ll, ll + ur - ul, ul),
            (None, Some(lr), Some(ul), Some(ur)) => (lr + ul - ur, lr, ul),
            _ => return self.refuse("", "a rectangle needs three of lower_left, lower_right, upper_left, upper_right"),
        };
        let wrong = |reason| DisplayError::NotRectangle { at: self.at(""), reason };
        let flat = FlatSurface::from_corners(ll, lr, ul).map_err(wrong)?;
        if let Some(ur) = ur {
            flat.closes(ur).map_err(wrong)?;
        }
        Ok(ScreenSurface::Flat(flat))
    }

    fn centre(&self) -> Result<ScreenSurface, DisplayError> {
        let given = self.given;
        let Some(centre) = given.centre else { return self.refuse("", "it has a size or angles, but no centre") };
        let Some(size) = given.size else { return self.refuse("centre", "it has a centre, but no size") };
        let angles = [given.yaw, given.pitch, given.roll].map(|angle| angle.unwrap_or(0.0));
        FlatSurface::from_centre(centre.into(), DVec2::from(size), angles.into())
            .map(ScreenSurface::Flat)
            .map_err(|reason| DisplayError::NotRectangle { at: self.at("size"), reason })
    }

    /// Checks the yaws left and right, the lower and upper end, and the radius of a curved screen.
    fn ranges(&self, key: &str, [left, right, bottom, top]: [f64; 4], radius: f64) -> Result<(), DisplayError> {
        if radius <= 0.0 {
            return self.refuse(key, format!("its radius is {radius} m; it must be more than 0"));
        }
        if !(left > right && left - right <= 360.0) {
            return self.refuse(
                key,
                format!(
                    "left = {left}° must be more than right = {right}°, by at most 360°: yaw is positive to the left"
                ),
            );
        }
        if top <= bottom {
            return self.refuse(key, format!("top = {top} must be more than bottom = {bottom}"));
        }
        Ok(())
    }

    fn cylinder(&self, given: &schema::CylinderTable) -> Result<ScreenSurface, DisplayError> {
        self.ranges("cylinder", [given.left, given.right, given.bottom, given.top], given.radius)?;
        Ok(ScreenSurface::Cylinder(CylinderSurface {
            centre: given.centre.into(),
            radius_m: given.radius,
            left_rad: given.left.to_radians(),
            right_rad: given.right.to_radians(),
            bottom_m: given.bottom,
            top_m: given.top,
        }))
    }

    fn sphere(&self, given: &schema::SphereTable) -> Result<ScreenSurface, DisplayError> {
        let [left, right] = [given.left.unwrap_or(180.0), given.right.unwrap_or(-180.0)];
        let [bottom, top] = [given.bottom.unwrap_or(0.0), given.top.unwrap_or(90.0)];
        self.ranges("sphere", [left, right, bottom, top], given.radius)?;
        if bottom < -90.0 || top > 90.0 {
            return self.refuse("sphere", format!("bottom = {bottom}° and top = {top}° are pitches: −90° to 90°"));
        }
        Ok(ScreenSurface::Sphere(SphereSurface {
            centre: given.centre.into(),
            radius_m: given.radius,
            left_rad: left.to_radians(),
            right_rad: right.to_radians(),
            bottom_rad: bottom.to_radians(),
            top_rad: top.to_radians(),
        }))
    }

    fn sweep(&self, given: &schema::SweepTable) -> Result<ScreenSurface, DisplayError> {
        let bend = given.bend.unwrap_or(0.0);
        if !(given.width > 0.0 && bend >= 0.0) {
            return self
                .refuse("sweep", format!("width = {} m must be more than 0, bend = {bend} m not less", given.width));
        }
        let profile: Vec<DVec2> = given.profile.iter().map(|&point| point.into()).collect();
        match sweep(given.centre.into(), given.width, &profile, bend) {
            Ok(mesh) => Ok(ScreenSurface::Mesh(Box::new(mesh))),
            Err(error) => self.refuse("sweep", error.to_string()),
        }
    }

    fn reflection(&self) -> Result<Reflection, DisplayError> {
        let given = self.given;
        let (gloss, exponent) = (given.gloss.unwrap_or(0.0), given.gloss_exponent.unwrap_or(20.0));
        if !(0.0..=1.0).contains(&gloss) {
            return self.refuse("gloss", format!("{gloss} is no share; write 0 (matt) to 1"));
        }
        if !(0.0..=10_000.0).contains(&exponent) {
            return self.refuse("gloss_exponent", format!("{exponent} is no exponent; write 0 to 10000"));
        }
        Ok(Reflection { gloss, exponent })
    }
}
