//! Windows: which pixels of which monitor a display owns, and how two eyes share them.
//!
//! Two windows, side by side and top–bottom need nothing but channels with viewports of their own. What is left is when both eyes' pictures
//! lie on the same pixels, and that is a property of the window ([`Combine`]): its left and right channels share one viewport.

/// Which monitor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Monitor {
    /// By the system's name, such as `DP-1`.
    Name(String),
    /// By its number in the system's order, from 0.
    Index(usize),
}

/// How the pictures of a left and a right channel with the same viewport become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Combine {
    /// They do not: viewports must not overlap.
    #[default]
    None,
    /// Even rows of the monitor's pixels are the left eye's, odd ones the right eye's.
    Rows,
    /// Even columns of the monitor's pixels are the left eye's, odd ones the right eye's.
    Columns,
    /// Pixels whose row plus column is even are the left eye's.
    Checker,
    /// Red–cyan by the least-squares matrices of E. Dubois (ICASSP 2001).
    AnaglyphDubois,
    /// Red–cyan of the luminances alone: no rivalry between the eyes, and no colours.
    AnaglyphGrey,
    /// Red from the left eye's luminance, green and blue as the right eye sees them.
    AnaglyphHalfColour,
}

impl Combine {
    /// All, in the order of the documentation.
    pub const ALL: [Self; 7] = [
        Self::None,
        Self::Rows,
        Self::Columns,
        Self::Checker,
        Self::AnaglyphDubois,
        Self::AnaglyphGrey,
        Self::AnaglyphHalfColour,
    ];

    /// As display files spell it.
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

    /// Whether colours separate the eyes: they then no longer show the Doppler shift (B 5.2).
    pub fn is_anaglyph(self) -> bool {
        matches!(self, Self::AnaglyphDubois | Self::AnaglyphGrey | Self::AnaglyphHalfColour)
    }
}

/// A window on a monitor.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowPlace {
    /// Unique among the windows.
    pub name: String,
    /// `None`: where the system puts it.
    pub monitor: Option<Monitor>,
    /// Pixels of its upper left from the monitor's (without a monitor: the desktop's), right and down. `None`: where the system puts it.
    pub position: Option<[i32; 2]>,
    /// Pixels inside, width and height.
    pub size: [u32; 2],
    /// Without a frame, over all of the monitor.
    pub fullscreen: bool,
    /// How left and right channels share pixels.
    pub combine: Combine,
    /// Left and right changed over in `combine`: for glasses or monitors that have them the other way round.
    pub swap_eyes: bool,
}
