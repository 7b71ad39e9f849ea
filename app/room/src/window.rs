//! Windows: the pixels of a monitor that a display uses, and how two eyes share them.
//!
//! Two windows, side by side and top–bottom stereo need only channels with viewports of their own. If both eyes'
//! pictures lie on the same pixels, that is a property of the window ([`Combine`]): its left and right channels share
//! one viewport.

/// Monitor on which a window opens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Monitor {
    /// A monitor by the system's name, such as `DP-1`.
    Name(String),
    /// A monitor by its number in the system's order, from 0.
    Index(usize),
}

/// Method of combining the pictures of a left and a right channel with the same viewport.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Combine {
    /// Separate pictures: viewports must not overlap.
    #[default]
    None,
    /// Even rows of the monitor's pixels for the left eye, odd rows for the right eye.
    Rows,
    /// Even columns of the monitor's pixels for the left eye, odd columns for the right eye.
    Columns,
    /// Pixels whose row plus column is even for the left eye, the others for the right eye.
    Checker,
    /// Red–cyan by the least-squares matrices of E. Dubois (ICASSP 2001).
    AnaglyphDubois,
    /// Red–cyan of the luminances alone: no rivalry between the eyes, and no colours.
    AnaglyphGrey,
    /// Red from the left eye's luminance, green and blue as the right eye sees them.
    AnaglyphHalfColour,
}

impl Combine {
    /// Methods in the order of the documentation.
    pub const ALL: [Self; 7] = [
        Self::None,
        Self::Rows,
        Self::Columns,
        Self::Checker,
        Self::AnaglyphDubois,
        Self::AnaglyphGrey,
        Self::AnaglyphHalfColour,
    ];

    /// Name of the method in display files.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Rows => "rows",
            Self::Columns => "columns",
            Self::Checker => "checker",
            Self::AnaglyphDubois => "anaglyph-dubois",
            Self::AnaglyphGrey => "anaglyph-grey",
            Self::AnaglyphHalfColour => "anaglyph-half-colour",
        }
    }

    /// True if colours separate the eyes. Such pictures cannot show the Doppler shift (B 5.2).
    pub fn is_anaglyph(self) -> bool {
        matches!(self, Self::AnaglyphDubois | Self::AnaglyphGrey | Self::AnaglyphHalfColour)
    }
}

/// A window on a monitor.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowPlace {
    /// Name, unique among the windows.
    pub name: String,
    /// Monitor on which the window opens; `None` leaves it to the system.
    pub monitor: Option<Monitor>,
    /// Offset of the window's upper left from the monitor's (without a monitor: from the desktop's), pixels right and
    /// down. `None` leaves it to the system.
    pub position: Option<[i32; 2]>,
    /// Width and height of the contents, pixels.
    pub size: [u32; 2],
    /// True for a window without a frame that fills the monitor.
    pub fullscreen: bool,
    /// Method by which left and right channels share pixels.
    pub combine: Combine,
    /// True if left and right are exchanged in `combine`, for glasses or monitors that have them the other way round.
    pub swap_eyes: bool,
}
