//! Outside view of the photo-surface (W 5.1.5): the views that its shader reads, and the marks that stand for the
//! observer.
//!
//! Apparent positions are relative to the eye, in the observer's axes, before any camera is known. So a camera anywhere
//! else in the observer's frame takes one translation. What is drawn, cut and left out is decided for that camera.

mod marks;
mod outline;
mod outside_views;

pub use marks::Marks;
pub use outside_views::outside_views;
