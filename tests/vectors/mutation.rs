//! A digit that differs is found: by the checksum in any place of a file, and without it, by
//! computing again.

use terraline::sink::vectors::selection::Choice;

use super::{Written, reader};

/// A scene whose files are small: a coarse kernel table, few nodes.
const SMALL: [&str; 3] =
    ["screen.size=[6, 4]", "kernel.table=16", "surface.map=\"builtin:jacksboro@6\""];

fn small(name: &str, full: bool) -> Written {
    let sets = if name == "plane" { &SMALL[..1] } else { &SMALL };
    Written::new(name, sets, full, Choice::Strips(4), 32)
}

/// The next digit, so that every digit becomes another one.
fn other(digit: u8) -> u8 {
    match digit {
        b'0'..=b'8' | b'a'..=b'e' => digit + 1,
        b'9' => b'a',
        b'f' | b'x' => b'0',
        _ => b'7',
    }
}

#[test]
fn a_file_with_another_digit_is_refused() {
    let mut tried = 0;
    for written in [small("flight", false), small("plane", false)] {
        for name in written.files().keys().map(|stem| format!("{stem}.mem")) {
            let path = written.folder.path().join("vectors").join(&name);
            let text = std::fs::read(path).expect("a file");
            // The long table of roots: a part of it.
            let stride = text.len().div_ceil(12_000);
            for at in (0..text.len()).step_by(stride) {
                let mut damaged = text.clone();
                damaged[at] = other(text[at]);
                let damaged = String::from_utf8(damaged).expect("ASCII");
                assert!(reader::read(&name, &damaged).is_err(), "{name}, byte {at}");
                tried += 1;
            }
            for cut in [1, 2, text.len() / 2] {
                let cut = String::from_utf8(text[..text.len() - cut].to_vec()).expect("ASCII");
                assert!(reader::read(&name, &cut).is_err(), "{name} without its end");
            }
        }
    }
    assert!(tried > 30_000, "{tried} digits");
}

#[test]
fn a_row_with_another_digit_is_not_what_the_units_answer() {
    let mut tried = 0;
    for written in [small("overview", false), small("flight", true), small("plane", false)] {
        let mut files = written.files();
        assert_eq!(written.grade(&files), Ok(()));
        for stem in files.keys().cloned().collect::<Vec<_>>() {
            let file = &files[&stem];
            let (rows, of_scene) = (file.rows.len(), file.of_scene);
            // A memory that the scene's rows do not need in full: a part of the long ones.
            for n in (0..rows).step_by(rows.div_ceil(30)) {
                for at in 0..files[&stem].columns.len() {
                    let column = files[&stem].columns[at].clone();
                    // Inputs of corner cases are anybody's choice, and need no certain answer.
                    if n >= of_scene && column.way == "in" && column.name != "set" {
                        continue;
                    }
                    let kept = files[&stem].rows[n][at];
                    let digits = column.notation.width.div_ceil(4);
                    for digit in 0..digits {
                        let width = column.notation.width;
                        let bit = (4 * digit + (n as u32 + digit) % 4).min(width - 1);
                        let flipped = match kept {
                            None => 0,
                            Some(value) if column.notation.signed => {
                                ((value ^ 1 << bit) << (64 - width)) >> (64 - width)
                            }
                            Some(value) => value ^ 1 << bit,
                        };
                        set(&mut files, &stem, n, at, Some(flipped));
                        let graded = written.grade(&files);
                        let name = &column.name;
                        assert!(graded.is_err(), "{stem} row {n}, {name} {kept:x?}, bit {bit}");
                        tried += 1;
                    }
                    set(&mut files, &stem, n, at, kept);
                }
            }
        }
        assert_eq!(written.grade(&files), Ok(()));
    }
    assert!(tried > 10_000, "{tried} digits");
}

fn set(
    files: &mut std::collections::BTreeMap<String, reader::File>,
    stem: &str,
    row: usize,
    column: usize,
    value: Option<i64>,
) {
    files.get_mut(stem).expect("the file").rows[row][column] = value;
}
