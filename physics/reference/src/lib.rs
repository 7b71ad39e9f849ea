//! References that `physics` is held against, by its tests and by measurements of the program's accuracy.
//!
//! The code here takes nothing from `physics`, so that a wrong formula there is not wrong here as well: [`real`]
//! computes with 600 bits, [`light`] has the textbook's formulas in that arithmetic, where cancellation has bits to
//! spare, and [`random`] draws the inputs.

pub mod light;
pub mod random;
pub mod real;
