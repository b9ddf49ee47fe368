//! The window itself: the only file that knows how windows are opened.

mod keys;

use std::sync::{Arc, Mutex, PoisonError};

use minifb::{MouseButton, MouseMode, ScaleMode, WindowOptions};

use super::canvas::Canvas;
use super::input::Input;
use super::run::Glass;
use keys::{Keys, Listener};

/// Ticks per second. Buttons are looked at once a tick: a click that is over sooner is not seen.
const TICKS: usize = 250;

/// An open window.
pub struct Window {
    window: minifb::Window,
    keys: Arc<Mutex<Keys>>,
}

impl Window {
    /// Opens a window of a size in pixels.
    ///
    /// # Errors
    /// The reason, where there is no display.
    pub fn open(title: &str, width: usize, height: usize) -> Result<Self, String> {
        // The canvas has every pixel of the window: nothing is left to scale.
        let options = WindowOptions {
            resize: true,
            scale_mode: ScaleMode::UpperLeft,
            ..WindowOptions::default()
        };
        let mut window = minifb::Window::new(title, width, height, options)
            .map_err(|error| error.to_string())?;
        window.set_target_fps(TICKS);
        let keys = Arc::<Mutex<Keys>>::default();
        window.set_input_callback(Box::new(Listener(Arc::clone(&keys))));
        Ok(Self { window, keys })
    }
}

/// The screen that windows open on. It is to be kept until the window is open: a display whose last
/// program leaves may start anew, and refuse others while it does.
pub struct Screen {
    #[cfg(all(unix, not(target_os = "macos")))]
    connection: Option<(x11rb::rust_connection::RustConnection, usize)>,
}

impl Screen {
    /// Looks for it.
    #[must_use]
    pub fn find() -> Self {
        Self {
            #[cfg(all(unix, not(target_os = "macos")))]
            connection: x11rb::connect(None).ok(),
        }
    }

    /// Pixels across and down; `None` where there is no screen, or where nobody can be asked.
    #[cfg(all(unix, not(target_os = "macos")))]
    #[must_use]
    pub fn size(&self) -> Option<(u32, u32)> {
        use x11rb::connection::Connection as _;
        let (connection, number) = self.connection.as_ref()?;
        let screen = connection.setup().roots.get(*number)?;
        Some((screen.width_in_pixels.into(), screen.height_in_pixels.into()))
    }

    /// Pixels across and down, which nobody can be asked for here.
    #[cfg(not(all(unix, not(target_os = "macos"))))]
    #[must_use]
    pub fn size(&self) -> Option<(u32, u32)> {
        None
    }
}

impl Glass for Window {
    fn size(&self) -> (usize, usize) {
        self.window.get_size()
    }

    fn poll(&mut self) -> Option<Input> {
        self.window.update();
        if !self.window.is_open() {
            return None;
        }
        let mut keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
        if !self.window.is_active() {
            // Keys that go up elsewhere are not reported.
            keys.forget();
        }
        let [left, right] =
            [MouseButton::Left, MouseButton::Right].map(|one| self.window.get_mouse_down(one));
        // Where there is one button, Control makes it the other.
        let orbit = right || left && keys.control();
        let mode = if left || right { MouseMode::Pass } else { MouseMode::Discard };
        let cursor = self.window.get_mouse_pos(mode);
        Some(Input {
            pressed: keys.take_pressed(),
            held: keys.take_held(),
            shift: keys.shift(),
            cursor: cursor.map(|(x, y)| (x.floor() as i32, y.floor() as i32)),
            button: left && !orbit,
            orbit,
            wheel: self.window.get_scroll_wheel().map_or(0.0, |(_, y)| y.into()),
        })
    }

    fn present(&mut self, canvas: &Canvas) -> Result<(), String> {
        let (width, height) = canvas.size();
        self.window
            .update_with_buffer(canvas.pixels(), width, height)
            .map_err(|error| error.to_string())
    }
}
