//! Keys and mouse from a text, one word per frame.
//!
//! | word | does |
//! |---|---|
//! | a character, as `w`, `3`, `/` | presses that key; a capital is the key with shift |
//! | `space`, `esc`, `tab`, `home`, `pageup`, `pagedown`, `left`, `right`, `up`, `down` | presses that key |
//! | `shift+1` to `shift+7`, `shift+KEY` | presses a key with shift |
//! | `move=X,Y` | puts the cursor there, window pixels |
//! | `click=X,Y` | puts the cursor there and clicks (two frames) |
//! | `drag=X,Y,X,Y` | drags from one place to the other (four frames) |
//! | `orbit=X,Y,X,Y` | the same with the right button |
//! | `orbit=X,Y,X,Y,N` | turns the wheel as well before the button goes up (five frames) |
//! | `wheel=N` | turns the wheel by N notches |
//! | `wait` | does nothing |

use super::input::{Input, Key};

/// Input of one frame after the other.
///
/// # Errors
/// A reason and a remedy, for a word that is none of those above.
pub fn parse(text: &str) -> Result<Vec<Input>, String> {
    let mut frames: Vec<Input> = Vec::new();
    let mut cursor = None;
    for word in text.split_whitespace() {
        let mut frame = |input: Input| {
            cursor = input.cursor.or(cursor);
            frames.push(Input { cursor, ..input });
        };
        match word.split_once('=') {
            Some(("move", places)) => {
                let [x, y] = numbers(word, places)?;
                frame(at(x, y, false));
            }
            Some(("click", places)) => {
                let [x, y] = numbers(word, places)?;
                frame(at(x, y, true));
                frame(at(x, y, false));
            }
            Some(("drag", places)) => {
                let [x, y, to_x, to_y] = numbers(word, places)?;
                frame(at(x, y, false));
                frame(at(x, y, true));
                frame(at(to_x, to_y, true));
                frame(at(to_x, to_y, false));
            }
            Some(("orbit", places)) => {
                let wheels = places.matches(',').count() == 4;
                let [x, y, to_x, to_y, notches] = if wheels {
                    numbers(word, places)?
                } else {
                    let [x, y, to_x, to_y] = numbers(word, places)?;
                    [x, y, to_x, to_y, 0]
                };
                let held = |x, y| Input { orbit: true, ..at(x, y, false) };
                frame(at(x, y, false));
                frame(held(x, y));
                frame(held(to_x, to_y));
                if wheels {
                    frame(Input { wheel: notches.into(), ..held(to_x, to_y) });
                }
                frame(at(to_x, to_y, false));
            }
            Some(("wheel", notches)) => {
                let [notches] = numbers(word, notches)?;
                frame(Input { wheel: notches.into(), ..Input::default() });
            }
            _ => frame(press(word)?),
        }
    }
    Ok(frames)
}

fn at(x: i32, y: i32, button: bool) -> Input {
    Input { cursor: Some((x, y)), button, ..Input::default() }
}

fn numbers<const N: usize>(word: &str, text: &str) -> Result<[i32; N], String> {
    let numbers: Result<Vec<i32>, _> = text.split(',').map(str::parse).collect();
    numbers
        .ok()
        .and_then(|numbers| numbers.try_into().ok())
        .filter(|numbers: &[i32; N]| numbers.iter().all(|n| n.unsigned_abs() < 1 << 20))
        .ok_or_else(|| {
            let plural = if N == 1 { "number" } else { "numbers, with commas between them" };
            format!("`{word}`: give {N} whole {plural}, as in move=320,200 or wheel=-2")
        })
}

fn press(word: &str) -> Result<Input, String> {
    if word == "wait" {
        return Ok(Input::default());
    }
    let (shift, name) = match word.strip_prefix("shift+") {
        Some(name) => (true, name),
        None => (false, word),
    };
    let mut characters = name.chars();
    let key = match (name, characters.next(), characters.next()) {
        ("space", ..) => Key::Char(' '),
        ("esc", ..) => Key::Escape,
        ("tab", ..) => Key::Tab,
        ("home", ..) => Key::Home,
        ("pageup", ..) => Key::PageUp,
        ("pagedown", ..) => Key::PageDown,
        ("left", ..) => Key::Left,
        ("right", ..) => Key::Right,
        ("up", ..) => Key::Up,
        ("down", ..) => Key::Down,
        (_, Some(digit @ '1'..='9'), None) if shift => Key::Shifted(digit as u8 - b'0'),
        (_, Some(letter), None) if shift => Key::Char(letter.to_ascii_uppercase()),
        (_, Some(character), None) => Key::Char(character),
        _ => {
            return Err(format!(
                "`{word}` is no key; give single characters, space, esc, tab, home, pageup, pagedown, left, right, up, \
                 down, shift+KEY, move=X,Y, click=X,Y, drag=X,Y,X,Y, orbit=X,Y,X,Y, wheel=N or wait"
            ));
        }
    };
    let (held, capital) = match key {
        // It saves a picture and does not fly.
        Key::Char('S') => (None, true),
        Key::Char(letter) => {
            (Some(Key::Char(letter.to_ascii_lowercase())), letter.is_ascii_uppercase())
        }
        Key::Left if shift => (Some(Key::RollLeft), false),
        Key::Right if shift => (Some(Key::RollRight), false),
        other => (Some(other), false),
    };
    Ok(Input {
        pressed: vec![key],
        held: held.into_iter().collect(),
        shift: shift || capital,
        ..Input::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_become_frames() {
        let frames = parse("w 3 shift+2 G space click=5,6 wheel=-2 wait").unwrap();
        let pressed: Vec<_> = frames.iter().flat_map(|frame| frame.pressed.clone()).collect();
        let expected =
            [Key::Char('w'), Key::Char('3'), Key::Shifted(2), Key::Char('G'), Key::Char(' ')];
        assert_eq!(pressed, expected);
        assert_eq!(frames.len(), 9);
        assert!(frames[3].shift && !frames[0].shift);
        assert_eq!(frames[3].held, [Key::Char('g')]);
        let held = |word: &str| parse(word).unwrap()[0].held.clone();
        assert_eq!(held("shift+left"), [Key::RollLeft]);
        assert_eq!((held("s"), held("S")), (vec![Key::Char('s')], vec![]));
        assert!(frames[5].button && !frames[6].button);
        assert_eq!((frames[7].wheel, frames[8].cursor), (-2.0, Some((5, 6))));
        assert_eq!(parse("drag=1,2,3,4").unwrap().len(), 4);
        let orbit = parse("orbit=1,2,3,4,-5").unwrap();
        assert_eq!(orbit.iter().map(|frame| frame.orbit).collect::<Vec<_>>(), [
            false, true, true, true, false
        ]);
        assert_eq!((orbit[3].wheel, orbit[3].cursor), (-5.0, Some((3, 4))));
        assert_eq!(parse("orbit=1,2,3,4").unwrap().len(), 4);
        assert_eq!(parse("  ").unwrap(), []);
    }

    #[test]
    fn what_is_no_key_is_named() {
        for word in ["ww", "move=1", "wheel=x", "drag=1,2", "orbit=1,2,3", "shift+", "jump=3", "move=9999999,0"] {
            let error = parse(&format!("w {word}")).unwrap_err();
            assert!(error.contains(word), "{error}");
        }
    }
}
