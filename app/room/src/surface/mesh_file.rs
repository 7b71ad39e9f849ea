//! Meshes read from files: Wavefront OBJ and CSV grids.

use super::mesh::MeshSurface;
use crate::{grid_file, read};
use glam::{DMat3, DVec2, DVec3};
use regular_file::Budget;
use std::collections::HashMap;
use std::path::Path;

/// Largest number of triangles that is read.
const MAX_TRIANGLES: usize = 4_000_000;

/// Largest memory of a mesh, in bytes of its text.
const BYTES_OF_TEXT: u64 = 10;

/// Largest memory of a mesh without places, in bytes of its text.
const LIT_BYTES_OF_TEXT: u64 = 20;

/// Reads the `.obj` or `.csv` file `path`. Error texts are worded to follow the file's name.
pub(crate) fn load(path: &Path, budget: &Budget) -> Result<MeshSurface, String> {
    let text = read::text(path, budget)?;
    budget.take(BYTES_OF_TEXT * text.len() as u64).map_err(|error| error.to_string())?;
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    match ending.as_str() {
        "obj" => obj(&text),
        "csv" => csv(&text),
        _ => Err("a mesh is an .obj or a .csv file".into()),
    }
}

/// Reads an OBJ text: `v x y z` in metres, `vt u v` from the lower left, `f v/vt …` counter-clockwise as seen by the
/// viewer. Other lines are ignored.
fn obj(text: &str) -> Result<MeshSurface, String> {
    let (mut positions, mut places) = (Vec::new(), Vec::new());
    let (mut points, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let mut vertices: HashMap<(usize, usize), u32> = HashMap::new();
    for (index, line) in text.lines().enumerate() {
        let wrong = |what: &str| format!("line {}: {what}", index + 1);
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => {
                positions.push(DVec3::from(numbers::<3>(words).ok_or_else(|| wrong("v needs three finite numbers"))?));
            }
            Some("vt") => {
                places.push(DVec2::from(numbers::<2>(words).ok_or_else(|| wrong("vt needs two finite numbers"))?));
            }
            Some("f") => {
                let mut face = Vec::new();
                for word in words {
                    let mut parts = word.split('/');
                    let v = parts.next().and_then(|part| nth(part, positions.len()));
                    let v = v.ok_or_else(|| wrong(&format!("{word:?} names no v that stands before it")))?;
                    let vt = parts.next().and_then(|part| nth(part, places.len()));
                    let vt = vt.ok_or_else(|| {
                        wrong(&format!(
                            "{word:?} names no vt; faces must be v/vt, so that a picture can lie on the mesh"
                        ))
                    })?;
                    let next = points.len() as u32;
                    let vertex = *vertices.entry((v, vt)).or_insert(next);
                    if vertex == next {
                        points.push(positions[v]);
                        uvs.push(places[vt]);
                    }
                    face.push(vertex);
                }
                if face.len() < 3 {
                    return Err(wrong("a face needs at least three corners"));
                }
                triangles.extend(face.windows(2).skip(1).map(|pair| [face[0], pair[0], pair[1]]));
                if triangles.len() > MAX_TRIANGLES {
                    return Err(wrong(&format!("it has more than {MAX_TRIANGLES} triangles")));
                }
            }
            _ => {}
        }
    }
    if triangles.is_empty() {
        return Err("it has no face (f)".into());
    }
    good(MeshSurface::new(points, uvs, &triangles))
}

/// Reads the points and faces of the `.obj` file `path`, without places: the mesh is only lit. Each triangle gets a
/// place of its own, so that they can be counted. Error texts are worded to follow the file's name.
pub(crate) fn shape(path: &Path, room_from_file: DMat3, budget: &Budget) -> Result<MeshSurface, String> {
    let text = read::text(path, budget)?;
    budget.take(LIT_BYTES_OF_TEXT * text.len() as u64).map_err(|error| error.to_string())?;
    let mirrored = room_from_file.determinant() < 0.0;
    let (mut positions, mut corners) = (Vec::new(), Vec::new());
    for (index, line) in text.lines().enumerate() {
        let wrong = |what: String| format!("line {}: {what}", index + 1);
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => {
                let position = numbers::<3>(words).ok_or_else(|| wrong("v needs three finite numbers".into()))?;
                positions.push(room_from_file * DVec3::from(position));
            }
            Some("f") => {
                let vertex = |word: &str| {
                    let number = word.split('/').next().unwrap_or_default();
                    let index = nth(number, positions.len());
                    index.ok_or_else(|| wrong(format!("{word:?} names no v that stands before it")))
                };
                let face = words.map(vertex).collect::<Result<Vec<usize>, String>>()?;
                if face.len() < 3 {
                    return Err(wrong("a face needs at least three corners".into()));
                }
                for pair in face.windows(2).skip(1) {
                    let (second, third) = if mirrored { (pair[1], pair[0]) } else { (pair[0], pair[1]) };
                    corners.extend([face[0], second, third]);
                }
                if corners.len() > 3 * MAX_TRIANGLES {
                    return Err(wrong(format!("it has more than {MAX_TRIANGLES} triangles")));
                }
            }
            _ => {}
        }
    }
    if corners.is_empty() {
        return Err("it has no face (f)".into());
    }
    let side = ((corners.len() / 3) as f64).sqrt().ceil();
    let place = |corner: usize| {
        let cell = DVec2::new(((corner / 3) as f64) % side, ((corner / 3) as f64 / side).floor());
        (cell + [DVec2::ZERO, DVec2::X, DVec2::Y][corner % 3]) / side
    };
    let uvs = (0..corners.len()).map(place).collect();
    let triangles: Vec<[u32; 3]> = (0..corners.len() as u32).step_by(3).map(|at| [at, at + 1, at + 2]).collect();
    good(MeshSurface::new(corners.into_iter().map(|corner| positions[corner]).collect(), uvs, &triangles))
}

/// Index from an OBJ number, which counts from 1, or backwards from −1.
fn nth(part: &str, count: usize) -> Option<usize> {
    let number: i64 = part.parse().ok()?;
    let index = if number > 0 { number - 1 } else { count as i64 + number };
    usize::try_from(index).ok().filter(|index| number != 0 && *index < count)
}

/// Reads a CSV text with lines `u, v, x, y, z`.
fn csv(text: &str) -> Result<MeshSurface, String> {
    let (columns, rows, points) = grid_file::read::<3>(text, "u, v, x, y, z")?;
    good(MeshSurface::grid(columns, rows, points.into_iter().map(DVec3::from).collect()))
}

fn good(mesh: MeshSurface) -> Result<MeshSurface, String> {
    if mesh.triangles().is_empty() {
        return Err("none of its triangles has an area".into());
    }
    let inside = |uv: &DVec2| uv.min_element() >= 0.0 && uv.max_element() <= 1.0;
    match mesh.uvs().iter().find(|uv| !inside(uv)) {
        Some(uv) => Err(format!("the place {uv} is outside 0 to 1")),
        None => Ok(mesh),
    }
}

/// First N numbers of a line; `None` if there are fewer, or if one is not finite.
fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>) -> Option<[f64; N]> {
    let mut found = [0.0; N];
    for number in &mut found {
        *number = words.next()?.parse().ok().filter(|number: &f64| number.is_finite())?;
    }
    Some(found)
}
