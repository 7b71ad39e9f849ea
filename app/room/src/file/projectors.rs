//! `[[projector]]` tables: the projector's place, and the lens that its keys describe.

use super::text::DisplayText;
use super::{names, schema};
use crate::error::{DisplayError, FilePlace};
use crate::lens::{LensTable, ProjectorLens};
use crate::projector::Projector;
use crate::turning::room_from_turned;
use crate::{grid_file, read};
use glam::DVec2;
use regular_file::Budget;
use std::path::Path;
use toml::Spanned;
use view::Tangents;

/// Largest memory of a lens's table, in bytes of its text.
const BYTES_OF_TEXT: u64 = 16;

/// Names of the lenses in files.
const LENSES: [&str; 3] = ["pinhole", "scan", "table"];

/// Projectors of all `[[projector]]` tables, in the file's order.
pub(super) fn resolve(
    text: &DisplayText<'_>,
    tables: &[Spanned<schema::ProjectorTable>],
    folder: &Path,
    budget: &Budget,
) -> Result<Vec<Projector>, DisplayError> {
    names::check(text, "projector", tables, |projector| &projector.name)?;
    tables
        .iter()
        .map(|table| {
            ProjectorForm { text, start: table.span().start, given: table.get_ref(), folder, budget }.projector()
        })
        .collect()
}

/// One `[[projector]]` table, and the byte of the text where it begins.
struct ProjectorForm<'a> {
    text: &'a DisplayText<'a>,
    start: usize,
    given: &'a schema::ProjectorTable,
    folder: &'a Path,
    budget: &'a Budget,
}

impl ProjectorForm<'_> {
    fn at(&self, key: &str) -> Box<FilePlace> {
        self.text.at(self.start, &format!("projector {:?}", self.given.name), key)
    }

    fn refuse<T>(&self, key: &str, reason: impl Into<String>) -> Result<T, DisplayError> {
        Err(DisplayError::Value { at: self.at(key), reason: reason.into() })
    }

    fn projector(&self) -> Result<Projector, DisplayError> {
        let given = self.given;
        let [x, y, z] = given.position;
        let angles = [given.yaw, given.pitch, given.roll].map(|angle| angle.unwrap_or(0.0));
        for (key, number) in [
            ("position", x),
            ("position", y),
            ("position", z),
            ("yaw", angles[0]),
            ("pitch", angles[1]),
            ("roll", angles[2]),
        ] {
            if !number.is_finite() {
                return self.refuse(key, format!("{number} is not a finite number"));
            }
        }
        Ok(Projector {
            name: given.name.clone(),
            position_m: given.position.into(),
            room_from_projector: room_from_turned(angles[0], angles[1], angles[2]),
            lens: self.lens()?,
            light: self.positive("light", given.light.unwrap_or(1.0))?,
            gamma: given.gamma.map(|gamma| self.positive("gamma", gamma)).transpose()?,
            even: given.even.unwrap_or(true),
            blend: given.blend.unwrap_or(true),
        })
    }

    fn positive(&self, key: &str, number: f64) -> Result<f64, DisplayError> {
        if number.is_finite() && number > 0.0 {
            Ok(number)
        } else {
            self.refuse(key, format!("{number} must be a number above 0"))
        }
    }

    fn lens(&self) -> Result<ProjectorLens, DisplayError> {
        let name = self.given.lens.as_deref().unwrap_or("pinhole");
        if !LENSES.contains(&name) {
            return Err(DisplayError::Unknown {
                at: self.at("lens"),
                kind: "lens",
                name: name.into(),
                known: LENSES.map(str::to_owned).to_vec(),
            });
        }

        // A key of another lens would have no effect, so it is refused as a mistake.
        let given = self.given;
        let keys = [
            ("throw_ratio", "pinhole", given.throw_ratio.is_some()),
            ("shift", "pinhole", given.shift.is_some()),
            ("tangents", "pinhole", given.tangents.is_some()),
            ("step", "scan", given.step.is_some()),
            ("magnification", "scan", given.magnification.is_some()),
            ("table", "table", given.table.is_some()),
        ];
        if let Some((key, of, _)) = keys.iter().find(|(_, of, present)| *present && *of != name) {
            return self.refuse(key, format!("it belongs to lens = {of:?}, but the lens is {name:?}"));
        }
        match name {
            "pinhole" => self.pinhole(),
            "scan" => self.scan(),
            _ => self.table(),
        }
    }

    fn size(&self) -> Result<[u32; 2], DisplayError> {
        match self.given.size {
            None => self.refuse("", "it needs its size in pixels"),
            Some(size) if size.contains(&0) => self.refuse("size", "a picture has at least one pixel each way"),
            Some(size) => Ok(size),
        }
    }

    fn pinhole(&self) -> Result<ProjectorLens, DisplayError> {
        let given = self.given;
        match (given.throw_ratio, given.tangents) {
            (Some(throw_ratio), None) => {
                let throw_ratio = self.positive("throw_ratio", throw_ratio)?;
                let [width, height] = self.size()?.map(f64::from);
                let shift = DVec2::from(given.shift.unwrap_or_default());
                if !shift.is_finite() {
                    return self.refuse("shift", "a number in it is not finite");
                }
                Ok(ProjectorLens::pinhole(throw_ratio, width / height, shift))
            }
            (None, Some([left, right, bottom, top])) => {
                if given.shift.is_some() {
                    return self.refuse("shift", "tangents have the shift in them already; leave one of them out");
                }
                if !(right - left > 0.0
                    && top - bottom > 0.0
                    && right - left < f64::INFINITY
                    && top - bottom < f64::INFINITY)
                {
                    return self
                        .refuse("tangents", "they are left, right, bottom, top: finite, left < right, bottom < top");
                }
                let (low, high) = (DVec2::new(left, bottom), DVec2::new(right, top));
                Ok(ProjectorLens::Pinhole(Tangents { low, high }))
            }
            _ => self.refuse("", "a pinhole needs either throw_ratio and size, or tangents"),
        }
    }

    fn scan(&self) -> Result<ProjectorLens, DisplayError> {
        let size = self.size()?;
        let Some(step) = self.given.step else {
            return self.refuse("", "a scanner needs its step in degrees per pixel");
        };
        let step = self.positive("step", step)?;
        let magnification = self.positive("magnification", self.given.magnification.unwrap_or(1.0))?;
        let lens = ProjectorLens::scan(size, step.to_radians(), magnification);

        // Beyond a quarter turn of a mirror, or half a turn of the light, two places of the picture have the same
        // direction.
        let halves = size.map(|side| 0.5 * f64::from(side) * step);
        let corner = (halves[0].to_radians().cos() * halves[1].to_radians().cos()).acos().to_degrees();
        if halves.iter().any(|half| *half >= 90.0) || magnification * corner >= 180.0 {
            return self.refuse(
                "step",
                "the picture would be wider than a scanner can turn; make step, magnification or size smaller",
            );
        }
        Ok(lens)
    }

    fn table(&self) -> Result<ProjectorLens, DisplayError> {
        let Some(name) = &self.given.table else { return self.refuse("", "lens = \"table\" needs table, a CSV file") };
        let path = self.folder.join(name);
        let lens = || -> Result<ProjectorLens, String> {
            let text = read::text(&path, self.budget)?;
            self.budget.take(BYTES_OF_TEXT * text.len() as u64).map_err(|error| error.to_string())?;
            let (columns, rows, angles) = grid_file::read::<2>(&text, "x, y, yaw, pitch")?;
            let angles = angles.iter().map(|angles| DVec2::from(*angles).map(f64::to_radians)).collect();
            Ok(ProjectorLens::Table(LensTable::new(columns, rows, angles)))
        };
        lens().map_err(|reason| DisplayError::Import { path: path.clone(), reason })
    }
}
