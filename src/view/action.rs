//! What hands can ask for, and what that asks of the world outside.

use crate::sink::picture::Picture;

use super::camera::Course;

/// A side of the split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of it, or everything where there is none.
    Left,
    /// Right of it.
    Right,
}

/// What hands can ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Show another picture on a side.
    Picture(Side, Picture),
    /// Show errors on a side, or there the next part of them.
    NextErrors(Side),
    /// The bright end of ramps of errors stands for four times as much (1), or for a quarter (-1).
    ErrorRange(i32),
    /// It stands for what is drawn again.
    FreeErrorRange,
    /// Draw a side by the next engine.
    NextEngine(Side),
    /// The next shape of the finite function.
    NextShape,
    /// Go on to the next deformation: 0, 1, 2.
    NextDeformation,
    /// Add to d of the weight 2^-d.
    Weight(i32),
    /// The next vertical exaggeration up (1) or down (-1).
    Exaggerate(i32),
    /// Turn the sun by degrees, clockwise and up.
    TurnSun(f64, f64),
    /// Go on by so many colour ramps.
    NextRamp(i32),
    /// Split the raster in two, or show one picture again.
    ToggleSplit,
    /// Move the split to a place across the raster, 0..=1.
    MoveSplit(f64),
    /// Stop the scan or let it go on.
    TogglePause,
    /// Draw one line and stop.
    OneLine,
    /// The next speed up.
    Faster,
    /// The next speed down.
    Slower,
    /// Show the keys, or hide them.
    ToggleHelp,
    /// Turn so many pages of the help, or of the status line without it.
    Page(i32),
    /// Show legends and status, or hide them.
    TogglePanels,
    /// Back to the scene's camera and field of view.
    Reset,
    /// Move to where the whole map is seen.
    FrameMap,
    /// Turn as if the scene were dragged by this many window pixels, right and down.
    Drag(f64, f64),
    /// Turn by degrees: heading to the left, nose up, right wing down.
    Turn(f64, f64, f64),
    /// Narrow the field of view by notches.
    Zoom(f64),
    /// Move along the line of sight by notches.
    Dolly(f64),
    /// Take hold of the ground in the middle of the screen, to orbit around it.
    HoldGround,
    /// Orbit around it as if the scene were dragged by this many window pixels, right and down.
    Orbit(f64, f64),
    /// Come nearer to it by notches.
    Approach(f64),
    /// Fly along a course for this many seconds.
    Fly(Course, f64),
    /// The cursor is at a place of the window, or has left it.
    Point(Option<(i32, i32)>),
    /// Explain the pixel at a place of the window.
    Explain(i32, i32),
    /// Save what is seen.
    Screenshot,
    /// Print the scene.
    CopyScene,
    /// Close the window.
    Quit,
}

/// What an action asks of the world outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Grant one line to the render worker.
    Line,
    /// Explain a pixel (column, line).
    Explain(u32, u32),
    /// Save what is seen.
    Screenshot,
    /// Print this scene file.
    Print(String),
    /// Close the window.
    Quit,
}
