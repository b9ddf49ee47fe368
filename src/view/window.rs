//! The window itself: the only file that knows how windows are opened.

use std::sync::{Arc, Mutex, PoisonError};

use minifb::{InputCallback, MouseButton, MouseMode, ScaleMode, WindowOptions};

use super::canvas::Canvas;
use super::input::{Input, Key};
use super::run::Glass;

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
            keys.down.clear();
        }
        let mut held = std::mem::take(&mut keys.touched);
        held.extend(keys.down.iter().filter_map(|&key| flies(key)));
        let button = self.window.get_mouse_down(MouseButton::Left);
        let mode = if button { MouseMode::Pass } else { MouseMode::Discard };
        let cursor = self.window.get_mouse_pos(mode);
        Some(Input {
            pressed: std::mem::take(&mut keys.pressed),
            held,
            shift: keys.shift(),
            cursor: cursor.map(|(x, y)| (x.floor() as i32, y.floor() as i32)),
            button,
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

/// Keys since the last tick. They are taken as they are reported: a key that goes down and up
/// between two ticks counts.
#[derive(Default)]
struct Keys {
    down: Vec<minifb::Key>,
    touched: Vec<Key>,
    pressed: Vec<Key>,
    /// The character of the key that went down last is not wanted.
    mute: bool,
}

impl Keys {
    fn shift(&self) -> bool {
        self.down.iter().any(|key| matches!(key, minifb::Key::LeftShift | minifb::Key::RightShift))
    }
}

struct Listener(Arc<Mutex<Keys>>);

impl InputCallback for Listener {
    /// Called after [`Self::set_key_state`] for the same key.
    fn add_char(&mut self, character: u32) {
        let mut keys = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let character = char::from_u32(character).filter(|c| !c.is_control());
        if let (Some(character), false) = (character, keys.mute) {
            keys.pressed.push(Key::Char(character));
        }
        keys.mute = false;
    }

    fn set_key_state(&mut self, key: minifb::Key, down: bool) {
        let mut keys = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        keys.mute = false;
        if !down {
            keys.down.retain(|&other| other != key);
            return;
        }
        let again = keys.down.contains(&key);
        if !again {
            keys.down.push(key);
        }
        keys.touched.extend(flies(key));
        // A key held down repeats itself; only those that go on step by step want that.
        let repeats = matches!(
            key,
            minifb::Key::LeftBracket
                | minifb::Key::RightBracket
                | minifb::Key::Period
                | minifb::Key::Minus
                | minifb::Key::Equal
        );
        if again && !repeats {
            keys.mute = true;
            return;
        }
        let shifted = keys.shift().then(|| digit(key)).flatten();
        match (shifted, key) {
            (Some(digit), _) => {
                keys.pressed.push(Key::Shifted(digit));
                keys.mute = true;
            }
            (None, minifb::Key::Escape) => keys.pressed.push(Key::Escape),
            (None, minifb::Key::Tab) => keys.pressed.push(Key::Tab),
            (None, minifb::Key::Home) => keys.pressed.push(Key::Home),
            _ => {}
        }
    }
}

fn digit(key: minifb::Key) -> Option<u8> {
    use minifb::Key as K;
    let digits = [K::Key1, K::Key2, K::Key3, K::Key4, K::Key5, K::Key6];
    digits.iter().position(|&digit| digit == key).map(|index| index as u8 + 1)
}

/// Keys that do something as long as they are down.
fn flies(key: minifb::Key) -> Option<Key> {
    use minifb::Key as K;
    Some(match key {
        K::W => Key::Char('w'),
        K::A => Key::Char('a'),
        K::S => Key::Char('s'),
        K::D => Key::Char('d'),
        K::Q => Key::Char('q'),
        K::E => Key::Char('e'),
        K::Left => Key::Left,
        K::Right => Key::Right,
        K::Up => Key::Up,
        K::Down => Key::Down,
        _ => return None,
    })
}
