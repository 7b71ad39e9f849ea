//! Positions of the renderers' dials that are measured.

use view::Dial;

/// Positions for stills.
pub const OF_STILLS: [Dial; 13] = [
    Dial::edge(2.0),
    Dial::edge(1.0),
    Dial::edge(0.5),
    Dial::vertex_stage(1.0),
    Dial::vertex_stage(0.5),
    Dial::tolerance(4.0),
    Dial::tolerance(2.0),
    Dial::tolerance(1.0),
    Dial::tolerance(0.5),
    Dial::tolerance(0.25),
    Dial::map(0.9),
    Dial::map(2.0),
    Dial::map(8.0),
];

/// Positions for rides.
pub const OF_RIDES: [Dial; 12] = [
    Dial::edge(2.0),
    Dial::edge(1.0),
    Dial::edge(0.5),
    Dial::vertex_stage(1.0),
    Dial::vertex_stage(0.5),
    Dial::tolerance(8.0),
    Dial::tolerance(4.0),
    Dial::tolerance(1.5),
    Dial::tolerance(0.75),
    Dial::map(0.5),
    Dial::map(0.9),
    Dial::map(1.5),
];
