//! Frames of reference of the diagram.

/// Frame of reference in which a diagram is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DiagramFrame {
    /// Frame in which the world rests.
    #[default]
    World,
    /// Frame in which the vehicle rests at present, a boost about the present event.
    Vehicle,
}

impl DiagramFrame {
    /// The other frame, for a key that switches.
    pub fn other(self) -> Self {
        match self {
            Self::World => Self::Vehicle,
            Self::Vehicle => Self::World,
        }
    }
}
