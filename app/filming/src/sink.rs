//! Files into which pictures go, written beside the drawing.

use crate::high_range::DeepPicture;
use crate::layout::{EYE_WORDS, StereoLayout};
use crossbeam_channel::{Sender, bounded};
use image::{Rgb32FImage, RgbaImage};
use picture_files::files::{WriteError, save};
use picture_files::film::{Film, FilmError, FilmForm, Written};
use picture_files::{FilmEyes, FilmProjection, HdrCurve, SequenceName, SphericalTags, exr};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use thiserror::Error;
use view::Projection;

/// Kind of numbered pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameFile {
    /// Developed pictures, as PNG.
    Png,
    /// Light, as OpenEXR.
    Exr,
    /// Signals for a screen of a high dynamic range, in films alone.
    Hdr(HdrCurve),
}

/// Reason why pictures could not be written.
#[derive(Debug, Error)]
pub enum SinkError {
    /// A film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// A numbered picture.
    #[error(transparent)]
    Picture(#[from] WriteError),
}

/// Pictures of one moment, one for each file.
#[derive(Clone, Debug)]
pub enum FramePictures {
    /// Developed pictures.
    Developed(Vec<RgbaImage>),
    /// Their light.
    Light(Vec<Rgb32FImage>),
    /// Signals of a high dynamic range.
    Deep(Vec<DeepPicture>),
}

/// Place of a film's pictures.
pub enum PictureSink {
    /// Films, one for each file of a moment.
    Films(Vec<Film>),
    /// Numbered pictures.
    Numbered(NumberedWriters),
}

/// Threads that write numbered pictures, as many as there are processors.
pub struct NumberedWriters {
    names: Vec<SequenceName>,
    work: Sender<(PathBuf, FramePictures)>,
    threads: Vec<JoinHandle<()>>,
    fault: Arc<Mutex<Option<WriteError>>>,
}

/// Paths of the files of a moment, or of films, by the arrangement of the eyes: `path` itself, or one for each eye.
pub fn eye_paths(path: &Path, layout: Option<StereoLayout>) -> Vec<PathBuf> {
    if layout != Some(StereoLayout::LeftRightFiles) {
        return vec![path.to_owned()];
    }
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, ending) = (part(path.file_stem()), part(path.extension()));
    EYE_WORDS.map(|word| path.with_file_name(format!("{stem}.{word}.{ending}"))).to_vec()
}

/// Names of the numbered files of a moment.
pub fn eye_names(name: &SequenceName, layout: Option<StereoLayout>) -> Vec<SequenceName> {
    match layout {
        Some(StereoLayout::LeftRightFiles) => EYE_WORDS.map(|word| name.with_word(word)).to_vec(),
        _ => vec![name.clone()],
    }
}

impl FramePictures {
    /// Pictures for the files, from those of each eye.
    #[must_use]
    pub fn arranged(self, layout: Option<StereoLayout>) -> Self {
        let Some(layout) = layout else { return self };
        match self {
            Self::Developed(pictures) => Self::Developed(match <[RgbaImage; 2]>::try_from(pictures) {
                Ok([left, right]) => layout.arranged(left, right),
                Err(pictures) => pictures,
            }),
            Self::Light(lights) if layout.files() == 1 && lights.len() == 2 => {
                Self::Light(vec![layout.joined(&lights[0], &lights[1])])
            }
            Self::Light(lights) => Self::Light(lights),
            Self::Deep(deep) if layout.files() == 1 && deep.len() == 2 => {
                Self::Deep(vec![layout.joined(&deep[0], &deep[1])])
            }
            Self::Deep(deep) => Self::Deep(deep),
        }
    }
}

/// What players are told of a film: `None` for a flat one of one eye, and for what no player knows.
pub fn film_tags(projection: Projection, layout: Option<StereoLayout>) -> Option<SphericalTags> {
    let eyes = layout.map_or(FilmEyes::One, StereoLayout::eyes);
    let projection = match projection {
        Projection::Sphere => FilmProjection::Sphere,
        Projection::Vr180 => FilmProjection::HalfSphere,
        Projection::Cube => FilmProjection::Cube,
        Projection::Flat if eyes != FilmEyes::One => FilmProjection::Flat,
        Projection::Flat | Projection::Fisheye { .. } => return None,
    };
    Some(SphericalTags { projection, eyes })
}

impl PictureSink {
    /// Films of pictures of `size` pixels, one for each path.
    ///
    /// # Errors
    /// Those of [`Film::create`].
    pub fn films(paths: &[PathBuf], size: [u32; 2], frames_per_second: f64, form: FilmForm) -> Result<Self, SinkError> {
        let films = paths.iter().map(|path| Film::create(path, size, frames_per_second, form));
        Ok(Self::Films(films.collect::<Result<_, _>>()?))
    }

    /// Numbered pictures of these names, one for each file of a moment.
    pub fn numbered(names: Vec<SequenceName>) -> Self {
        let count = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let (work, queue) = bounded::<(PathBuf, FramePictures)>(count);
        let fault = Arc::new(Mutex::new(None));
        let thread = |number: usize| {
            let (queue, fault) = (queue.clone(), Arc::clone(&fault));
            let write = move || {
                for (path, pictures) in queue {
                    if let Err(error) = written(&path, pictures) {
                        fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                        break;
                    }
                }
            };
            std::thread::Builder::new().name(format!("writer {number}")).spawn(write).ok()
        };
        let threads = (0..count).filter_map(thread).collect();
        Self::Numbered(NumberedWriters { names, work, threads, fault })
    }

    /// Adds the pictures of a moment. Returns false once nothing can be written any more; [`finish`](Self::finish)
    /// then gives the reason.
    pub fn add(&self, number: u64, pictures: FramePictures) -> bool {
        match (self, pictures) {
            (Self::Films(films), FramePictures::Developed(pictures)) => {
                films.iter().zip(pictures).all(|(film, picture)| film.add(picture))
            }
            (Self::Films(films), FramePictures::Deep(pictures)) => {
                films.iter().zip(pictures).all(|(film, picture)| film.add(picture))
            }
            (Self::Films(_), FramePictures::Light(_)) => false,
            (Self::Numbered(writers), pictures) => writers.add(number, pictures),
        }
    }

    /// Waits until everything is written. Returns what became of each film; nothing for numbered pictures.
    ///
    /// # Errors
    /// [`SinkError`] of the encoder or the disk.
    pub fn finish(self) -> Result<Vec<Written>, SinkError> {
        match self {
            Self::Films(films) => Ok(films.into_iter().map(Film::finish).collect::<Result<_, _>>()?),
            Self::Numbered(NumberedWriters { work, threads, fault, .. }) => {
                drop(work);
                for thread in threads {
                    thread.join().expect("a writer keeps its errors");
                }
                match fault.lock().unwrap_or_else(PoisonError::into_inner).take() {
                    Some(error) => Err(error.into()),
                    None => Ok(Vec::new()),
                }
            }
        }
    }
}

impl NumberedWriters {
    fn add(&self, number: u64, pictures: FramePictures) -> bool {
        let each: Vec<FramePictures> = match pictures {
            FramePictures::Developed(pictures) => {
                pictures.into_iter().map(|picture| FramePictures::Developed(vec![picture])).collect()
            }
            FramePictures::Light(lights) => lights.into_iter().map(|light| FramePictures::Light(vec![light])).collect(),
            FramePictures::Deep(deep) => deep.into_iter().map(|deep| FramePictures::Deep(vec![deep])).collect(),
        };
        let sound = self.fault.lock().unwrap_or_else(PoisonError::into_inner).is_none();
        sound && self.names.iter().zip(each).all(|(name, picture)| self.work.send((name.path(number), picture)).is_ok())
    }
}

/// Writes the pictures of a file.
fn written(path: &Path, pictures: FramePictures) -> Result<(), WriteError> {
    match pictures {
        FramePictures::Developed(pictures) => pictures.into_iter().try_for_each(|picture| save(picture, path)),
        FramePictures::Light(lights) => lights.iter().try_for_each(|light| exr::save(light, path)),
        FramePictures::Deep(deep) => deep.into_iter().try_for_each(|deep| save(deep, path)),
    }
}
