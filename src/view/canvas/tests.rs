use super::help::{KEYS, pages};

#[test]
fn the_help_is_whole_in_any_window() {
    // Characters across and rows down of windows of 420x320, 200x120 and more.
    for (across, down) in [(57, 19), (30, 8), (68, 40), (120, 60), (30, 3)] {
        let pages = pages(across, down);
        let lines: Vec<_> = pages.concat();
        for (key, means) in KEYS {
            let at = lines.iter().position(|(known, _)| *known == key).expect("the key");
            let more = lines[at + 1..].iter().take_while(|(key, _)| key.is_empty());
            let text: Vec<&str> =
                lines[at..=at].iter().chain(more).map(|(_, text)| text.as_str()).collect();
            assert_eq!(text.join(" "), means);
        }
        for page in &pages {
            // An entry is never parted, so that a page may be longer where it alone is.
            assert!(page.len() <= down || down < 8, "{across} {down}: {page:?}");
        }
        assert_eq!(pages.len() > 1, down < 40, "{across} {down}");
    }
}
