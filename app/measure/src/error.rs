//! Reasons why something cannot be measured.

use crate::extremes::ExtremesError;
use crate::plot::PlotError;
use physics::photo_surface::PhotoSurfaceError;
use physics::worldline::WorldlineError;
use render::GpuError;
use ride::SetupError;
use scene::SceneFault;
use scene::refine::RefineError;
use thiserror::Error;

/// Reason why something cannot be measured.
#[derive(Debug, Error)]
pub enum MeasureError {
    /// A device that is missing or lost.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A scene that breaks a promise of its types.
    #[error(transparent)]
    Scene(#[from] SceneFault),
    /// A scene that cannot be cut so finely.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// A scene whose origin is not finite.
    #[error(transparent)]
    PhotoSurface(#[from] PhotoSurfaceError),
    /// A worldline that cannot be followed.
    #[error(transparent)]
    Worldline(#[from] WorldlineError),
    /// A ride that cannot begin.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Physics less accurate than promised.
    #[error(transparent)]
    Extremes(#[from] ExtremesError),
    /// A plot that cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
}
