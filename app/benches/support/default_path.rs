//! The way in which `rapidity ride` draws without options, and the scenes that are measured.

use super::table_scenes::{SIZES, scene_of};
use built_in::lattice::Lattice;
use built_in::town;
use command::{Command, parse_from};
use regular_file::Budget;
use render::Gpu;
use render::choice::Choice;
use render::target::Format;
use scene::Scene;
use scene_files::gltf::ReadRules;
use std::error::Error;
use std::path::Path;
use view::{Dial, Effects, Occasion, RendererName};

/// Memory that a scene's file may take, bytes.
const FILE_LIMIT: u64 = 8 << 30;

/// The way in which a scene is drawn without options.
#[derive(Clone, Copy)]
pub struct DefaultPath {
    /// Method that `auto` chooses, and its setting.
    pub dial: Dial,
    /// Format of the targets.
    pub format: Format,
    /// Effects.
    pub effects: Effects,
}

impl DefaultPath {
    /// Default path for a scene on this device.
    pub fn of(gpu: &Gpu, scene: &Scene) -> Result<Self, Box<dyn Error>> {
        let Ok(Command::Ride(options)) = parse_from(["rapidity", "ride"]) else {
            return Err("`rapidity ride` is no command".into());
        };
        let format = Format::fast(options.samples(gpu.is_software()));
        let Choice { dial, .. } = Choice::of(scene.clone(), options.dial(gpu.is_software()), Occasion::Ride)?;
        Ok(Self { dial, format, effects: options.picture.effects })
    }

    /// Name of the row that is drawn by it.
    pub fn name(&self) -> String {
        format!("default: {}", method(self.dial))
    }

    /// The other method, at its usual setting in rides.
    pub fn other(&self) -> Dial {
        let renderer = match self.dial.renderer {
            RendererName::Image => RendererName::Polygon,
            _ => RendererName::Image,
        };
        Dial { renderer, ..self.dial }
    }
}

/// Name of a method with its setting.
pub fn method(dial: Dial) -> String {
    match (dial.renderer, dial.edge, dial.tolerance, dial.map_scale) {
        (RendererName::Image, _, _, Some(scale)) => format!("image, map {scale}"),
        (_, Some(edge_m), _, _) => format!("polygon, edge {edge_m}"),
        (_, _, Some(tolerance_px), _) => format!("polygon, {tolerance_px} px"),
        (renderer, ..) => renderer.name().to_owned(),
    }
}

/// Scene by name: `town`, `lattice`, or `table1` to `table3` for those of W table 6.1; or from a file.
pub fn scene(name: &str) -> Result<Scene, Box<dyn Error>> {
    let number = name.strip_prefix("table").and_then(|number| number.parse::<usize>().ok());
    if let Some([vertices, triangles]) = number.and_then(|number| SIZES.get(number.checked_sub(1)?)) {
        return Ok(scene_of(*vertices, *triangles)?);
    }
    match name {
        "town" => Ok(town::build(town::TOWN_SEED)),
        "lattice" => Ok(Lattice::default().build()),
        path => {
            let rules = ReadRules { budget: &Budget::new(FILE_LIMIT), trust: false };
            Ok(scene_files::read(Path::new(path), rules, |_| ())?)
        }
    }
}
