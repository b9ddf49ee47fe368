//! Keys, as the window reports them one after the other.

use std::sync::{Arc, Mutex, PoisonError};

use minifb::InputCallback;

use crate::view::input::Key;

/// Keys since the last tick. They are taken as they are reported: a key that goes down and up
/// between two ticks counts.
#[derive(Default)]
pub(super) struct Keys {
    down: Vec<Down>,
    touched: Vec<Key>,
    pressed: Vec<Key>,
    /// The character of the key that went down last is not wanted.
    mute: bool,
}

/// A key that is down.
#[derive(Clone, Copy)]
struct Down {
    key: minifb::Key,
    /// It went down with Shift, and means what it means with Shift until it goes up.
    shifted: bool,
}

impl Keys {
    /// Whether Shift is down.
    pub(super) fn shift(&self) -> bool {
        use minifb::Key as K;
        self.down.iter().any(|down| matches!(down.key, K::LeftShift | K::RightShift))
    }

    /// Whether Control is down.
    pub(super) fn control(&self) -> bool {
        use minifb::Key as K;
        self.down.iter().any(|down| matches!(down.key, K::LeftCtrl | K::RightCtrl))
    }

    /// No key is down any more.
    pub(super) fn forget(&mut self) {
        self.down.clear();
    }

    /// Keys that went down since the last call.
    pub(super) fn take_pressed(&mut self) -> Vec<Key> {
        std::mem::take(&mut self.pressed)
    }

    /// Keys that are down or were since the last call, of those that act as long as they are.
    pub(super) fn take_held(&mut self) -> Vec<Key> {
        let mut held = std::mem::take(&mut self.touched);
        held.extend(self.down.iter().filter_map(|down| flies(*down)));
        held
    }

    fn goes_down(&mut self, key: minifb::Key) {
        let shift = self.shift();
        let again = self.down.iter().find(|down| down.key == key).copied();
        let down = again.unwrap_or(Down { key, shifted: shift });
        if again.is_none() {
            self.down.push(down);
        }
        self.touched.extend(flies(down));
        // A key held down repeats itself. Only those that go on step by step want that, and not as
        // another key, with Shift gone up or down meanwhile.
        if again.is_some() && !(repeats(key) && down.shifted == shift) {
            self.mute = true;
            return;
        }
        let named = match key {
            _ if shift && let Some(digit) = digit(key) => Key::Shifted(digit),
            minifb::Key::Escape => Key::Escape,
            minifb::Key::Tab => Key::Tab,
            minifb::Key::Home => Key::Home,
            minifb::Key::PageUp => Key::PageUp,
            minifb::Key::PageDown => Key::PageDown,
            _ => return,
        };
        self.pressed.push(named);
        self.mute = true;
    }
}

/// Takes what the window reports.
pub(super) struct Listener(pub(super) Arc<Mutex<Keys>>);

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
        if down {
            keys.goes_down(key);
        } else {
            keys.down.retain(|other| other.key != key);
        }
    }
}

/// Keys that act again and again while they are down.
fn repeats(key: minifb::Key) -> bool {
    use minifb::Key as K;
    matches!(
        key,
        K::LeftBracket | K::RightBracket | K::Period | K::Minus | K::Equal | K::L | K::O | K::V
    )
}

fn digit(key: minifb::Key) -> Option<u8> {
    use minifb::Key as K;
    let digits = [K::Key1, K::Key2, K::Key3, K::Key4, K::Key5, K::Key6, K::Key7];
    digits.iter().position(|&digit| digit == key).map(|index| index as u8 + 1)
}

/// What keys do as long as they are down.
fn flies(down: Down) -> Option<Key> {
    use minifb::Key as K;
    Some(match (down.key, down.shifted) {
        (K::W, _) => Key::Char('w'),
        (K::A, _) => Key::Char('a'),
        // With Shift it saves a picture.
        (K::S, false) => Key::Char('s'),
        (K::D, _) => Key::Char('d'),
        (K::Q, _) => Key::Char('q'),
        (K::E, _) => Key::Char('e'),
        (K::Left, false) => Key::Left,
        (K::Right, false) => Key::Right,
        (K::Left, true) => Key::RollLeft,
        (K::Right, true) => Key::RollRight,
        (K::Up, _) => Key::Up,
        (K::Down, _) => Key::Down,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use minifb::Key as K;

    /// Keys behind a keyboard that types the characters of an American one.
    #[derive(Default)]
    struct Hand(Arc<Mutex<Keys>>);

    impl Hand {
        /// A key goes down, or repeats itself while it is.
        fn down(&self, key: K) -> &Self {
            let mut listener = Listener(Arc::clone(&self.0));
            let shift = self.0.lock().unwrap().shift();
            listener.set_key_state(key, true);
            let typed = match (key, shift) {
                (K::S, false) => 's',
                (K::S, true) => 'S',
                (K::W, false) => 'w',
                (K::W, true) => 'W',
                (K::G, false) => 'g',
                (K::G, true) => 'G',
                (K::Key4, false) => '4',
                (K::Key4, true) => '$',
                (K::Period, false) => '.',
                (K::Period, true) => '>',
                _ => return self,
            };
            listener.add_char(typed.into());
            self
        }

        fn up(&self, key: K) -> &Self {
            Listener(Arc::clone(&self.0)).set_key_state(key, false);
            self
        }

        fn took(&self) -> (Vec<Key>, Vec<Key>) {
            let mut keys = self.0.lock().unwrap();
            let mut held = keys.take_held();
            held.dedup();
            (keys.take_pressed(), held)
        }
    }

    #[test]
    fn a_key_with_shift_acts_once_whichever_goes_up_first() {
        for (key, acts) in
            [(K::Key4, Key::Shifted(4)), (K::S, Key::Char('S')), (K::G, Key::Char('G'))]
        {
            let hand = Hand::default();
            hand.down(K::LeftShift).down(key).down(key);
            assert_eq!(hand.took(), (vec![acts], vec![]));
            // Shift goes up, the key repeats itself: it is no plain key.
            hand.up(K::LeftShift).down(key).down(key);
            assert_eq!(hand.took(), (vec![], vec![]), "{key:?}");
            // Nor is one that is still down when Shift goes down again.
            hand.down(K::LeftShift).down(key).up(key).up(K::LeftShift);
            assert_eq!(hand.took(), (vec![], vec![]), "{key:?}");
            // The next time it is.
            hand.down(key);
            let (pressed, _) = hand.took();
            assert_eq!(pressed.len(), 1, "{key:?}");
            assert!(!pressed.contains(&acts), "{key:?}");
        }
    }

    #[test]
    fn flight_goes_on_when_shift_comes_or_goes() {
        let hand = Hand::default();
        for step in [&|| hand.down(K::LeftShift).down(K::W), &|| hand.up(K::LeftShift).down(K::W)]
            as [&dyn Fn() -> _; 2]
        {
            step();
            assert_eq!(hand.took().1, [Key::Char('w')]);
        }
        hand.up(K::W);
        assert_eq!(hand.took().1, []);
        // S that flew before Shift goes on flying, and saves nothing.
        hand.down(K::S).down(K::LeftShift).down(K::S);
        assert_eq!(hand.took(), (vec![Key::Char('s')], vec![Key::Char('s')]));
        // An arrow that rolls does not turn at last.
        hand.down(K::Left).up(K::LeftShift).down(K::Left);
        assert!(hand.took().1.contains(&Key::RollLeft));
    }

    #[test]
    fn steps_repeat_with_shift_as_it_was() {
        let hand = Hand::default();
        hand.down(K::Period).down(K::Period).down(K::Period);
        assert_eq!(hand.took().0, [Key::Char('.'); 3]);
        hand.up(K::Period).down(K::LeftShift).down(K::Period).up(K::LeftShift).down(K::Period);
        assert_eq!(hand.took().0, [Key::Char('>')]);
    }

    #[test]
    fn a_key_between_two_ticks_counts() {
        let hand = Hand::default();
        hand.down(K::W).up(K::W);
        assert_eq!(hand.took(), (vec![Key::Char('w')], vec![Key::Char('w')]));
        assert_eq!(hand.took(), (vec![], vec![]));
    }
}
