//! The thesis, docs/sources.md, docs/mathematics.md and the code's citations, held to each other.
//!
//! `UPDATE_DOCS=1` rewrites the last section of docs/mathematics.md, which lists the files that
//! cite an equation.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use terraline::setup::table;
use terraline::word::Register;

/// The thesis numbers its equations 2.1 to 2.63.
const THESIS: std::ops::RangeInclusive<u32> = 1..=63;

/// Heading of the section of docs/mathematics.md that is generated.
const CITED: &str = "## Where the equations are cited\n";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(file: impl AsRef<Path>) -> String {
    let path = root().join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A list of numbers at the start of a text, "9", "5 and 6", "14 to 18" or "5, 6, 8", each after
/// `prefix`; and what follows it.
fn list<'a>(text: &'a str, prefix: &str) -> Option<(BTreeSet<u32>, &'a str)> {
    let number = |text: &'a str| {
        let digits = text.strip_prefix(prefix)?;
        let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        Some((digits[..end].parse::<u32>().ok()?, &digits[end..]))
    };
    let (mut last, mut rest) = number(text)?;
    let mut numbers = BTreeSet::from([last]);
    loop {
        let next = |word| rest.strip_prefix(word).and_then(number);
        if let Some((to, after)) = next(" to ") {
            assert!(last < to, "{text}: an empty range");
            numbers.extend(last..=to);
            (last, rest) = (to, after);
        } else if let Some((one, after)) =
            next(" and ").or_else(|| next(", and ")).or_else(|| next(", "))
        {
            numbers.insert(one);
            (last, rest) = (one, after);
        } else {
            return Some((numbers, rest));
        }
    }
}

/// What ties an equation of the thesis to one of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Claim {
    thesis: u32,
    ours: u32,
    /// Ours stands in its place and differs.
    replaced: bool,
}

/// An equation of docs/mathematics.md.
struct Equation {
    /// Heading above it.
    section: String,
    /// What its bracket claims; empty where it is ours alone.
    claims: Vec<Claim>,
    /// The equations of the thesis that code cites beside it.
    cited: BTreeSet<u32>,
}

/// The numbered equations of docs/mathematics.md with the brackets under them.
///
/// # Panics
/// If there are none, numbers are not 1, 2, 3 …, or a bracket is missing or not understood.
fn equations(page: &str) -> BTreeMap<u32, Equation> {
    let mut found = BTreeMap::new();
    let (mut section, mut tag) = ("", None);
    for line in page.lines() {
        if line.starts_with('#') {
            section = line.trim_start_matches('#').trim();
        } else if let Some((_, number)) = line.split_once("\\tag{") {
            assert!(tag.is_none(), "no bracket under equation {tag:?}");
            tag = list(number, "").and_then(|(numbers, _)| numbers.first().copied());
            assert!(tag.is_some(), "{line}: not a number");
        } else if let Some(bracket) = line.strip_prefix('[').filter(|_| tag.is_some()) {
            let number = tag.take().expect("a tag");
            let bracket = bracket.strip_suffix(']').expect("a bracket of one line");
            let equation = equation(section, number, bracket);
            assert!(found.insert(number, equation).is_none(), "equation {number} twice");
        }
    }
    assert!(tag.is_none(), "no bracket under equation {tag:?}");
    assert!(!found.is_empty(), "no equation found");
    assert!(found.keys().copied().eq(1..=found.len() as u32), "numbers with gaps");
    found
}

/// An equation from its bracket: "thesis 2.51, 2.52; also 2.40; also replaces 2.58", "ours: why".
fn equation(section: &str, ours: u32, bracket: &str) -> Equation {
    let mut claims = Vec::new();
    let mut cited = BTreeSet::new();
    if let Some(why) = bracket.strip_prefix("ours: ") {
        assert!(!why.is_empty(), "({ours}): ours, because?");
    } else {
        for (place, part) in bracket.split("; ").enumerate() {
            let part = if place == 0 { Some(part) } else { part.strip_prefix("also ") };
            let part = part.unwrap_or_else(|| panic!("({ours}): \"also\" is missing"));
            let replaced = part.starts_with("replaces ");
            let part = part.trim_start_matches("replaces ").trim_start_matches("thesis ");
            let numbers = match list(part, "2.") {
                Some((numbers, "")) => numbers,
                _ => panic!("({ours}): [{bracket}] is not understood"),
            };
            claims.extend(numbers.iter().map(|&thesis| Claim { thesis, ours, replaced }));
            if place == 0 {
                cited = numbers;
            }
        }
    }
    Equation { section: section.to_owned(), claims, cited }
}

/// The anchor of a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || [' ', '-'].contains(c));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

/// What is wrong between docs/sources.md, docs/mathematics.md and docs/differences.md.
///
/// # Panics
/// If the first has no row of an equation, or one that is not understood.
fn faults_of_pages(sources: &str, mathematics: &str, differences: &str) -> Vec<String> {
    let equations = equations(mathematics);
    let mut faults = Vec::new();
    let mut rows = BTreeMap::new();
    let mut claims = BTreeSet::new();
    for line in sources.lines().filter(|line| line.starts_with("| 2.")) {
        let [thesis, what, place] =
            line.trim_matches(['|', ' ']).split(" | ").collect::<Vec<_>>()[..]
        else {
            panic!("{line}: not three columns");
        };
        let thesis: u32 = thesis.trim_start_matches("2.").parse().expect("a number");
        assert!(!what.is_empty(), "2.{thesis}: what is it?");
        *rows.entry(thesis).or_insert(0) += 1;
        if let Some(why) = place.strip_prefix("not used, because ") {
            assert!(!why.is_empty(), "2.{thesis}: because?");
            continue;
        }
        for item in place.split("; ") {
            let replaced = item.starts_with("replaced by ");
            let rest = item.trim_start_matches("replaced by ").strip_prefix('(');
            let Some((numbers, link)) = rest.and_then(|rest| list(rest, "")) else {
                panic!("2.{thesis}: \"{item}\" is not understood");
            };
            for ours in numbers {
                claims.insert(Claim { thesis, ours, replaced });
                let Some(Equation { section, .. }) = equations.get(&ours) else {
                    faults.push(format!("2.{thesis}: there is no equation {ours}"));
                    continue;
                };
                if link != format!(") [{section}](mathematics.md#{})", anchor(section)) {
                    faults.push(format!("2.{thesis}: ({ours}) stands under \"{section}\""));
                }
            }
        }
    }
    assert!(!rows.is_empty(), "no rows found");
    for thesis in THESIS.chain(rows.keys().copied().filter(|row| !THESIS.contains(row))) {
        let count = rows.get(&thesis).copied().unwrap_or(0);
        if count != 1 || !THESIS.contains(&thesis) {
            faults.push(format!("thesis 2.{thesis} has {count} rows"));
        }
    }
    let brackets: BTreeSet<_> = equations.values().flat_map(|e| e.claims.iter().copied()).collect();
    for claim in claims.symmetric_difference(&brackets) {
        faults.push(format!("{claim:?} is in one of sources.md and mathematics.md"));
    }
    let explained: BTreeSet<u32> = differences
        .split("thesis ")
        .filter_map(|after| list(after, "2."))
        .flat_map(|(numbers, _)| numbers)
        .collect();
    for Claim { thesis, .. } in brackets.iter().filter(|claim| claim.replaced) {
        if !explained.contains(thesis) {
            faults.push(format!("differences.md does not say how thesis 2.{thesis} is replaced"));
        }
    }
    faults
}

/// The comments of a source as one text each, and the other lines; whether it is a comment.
fn blocks(source: &str) -> Vec<(bool, String)> {
    let mut blocks: Vec<(bool, String)> = Vec::new();
    let mut open = false;
    for line in source.lines() {
        let full = line.trim_start().strip_prefix("//");
        let (code, comment) = match full {
            Some(comment) => ("", Some(comment)),
            None => line.split_once(" // ").map_or((line, None), |(code, it)| (code, Some(it))),
        };
        if !code.is_empty() {
            blocks.push((false, code.to_owned()));
        }
        if let Some(comment) = comment {
            let comment = comment.trim_start_matches(['/', '!']).trim();
            match blocks.last_mut().filter(|_| open && full.is_some()) {
                Some((_, text)) => *text = format!("{text} {comment}"),
                None => blocks.push((true, comment.to_owned())),
            }
        }
        open = comment.is_some();
    }
    blocks
}

/// The equations that a source cites, and what is wrong with its citations.
fn citations(source: &str, equations: &BTreeMap<u32, Equation>) -> (BTreeSet<u32>, Vec<String>) {
    let mut all = BTreeSet::new();
    let mut faults = Vec::new();
    for (comment, text) in blocks(source) {
        for after in text.split("thesis ").skip(1) {
            let numbers = list(after, "2.").map_or(BTreeSet::new(), |(numbers, _)| numbers);
            for number in numbers.into_iter().filter(|number| !THESIS.contains(number)) {
                faults.push(format!("there is no thesis 2.{number}"));
            }
        }
        for after in text.split("quation").skip(1) {
            let after = after.strip_prefix('s').unwrap_or(after).trim_start();
            let Some((numbers, after)) = list(after, "") else {
                continue;
            };
            let unknown = numbers.iter().find(|number| !equations.contains_key(number));
            if let Some(number) = unknown {
                faults.push(format!("there is no equation {number}"));
                continue;
            }
            let after = after.strip_prefix(" of docs/mathematics.md").unwrap_or(after);
            let beside = after.strip_prefix("; thesis ").and_then(|after| list(after, "2."));
            let beside = beside.map_or(BTreeSet::new(), |(numbers, _)| numbers);
            let expected = numbers.iter().flat_map(|number| &equations[number].cited);
            let expected: BTreeSet<u32> = expected.copied().collect();
            if comment && beside != expected {
                faults.push(format!(
                    "beside equations {numbers:?} stands thesis 2.{beside:?}, not 2.{expected:?}"
                ));
            }
            all.extend(numbers);
        }
    }
    (all, faults)
}

/// All files below a folder whose names end so.
fn files(folder: &str, end: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{folder:?}: {e}")) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|it| it == end) {
                found.push(path.strip_prefix(root()).expect("under the root").to_owned());
            }
        }
    }
    assert!(!found.is_empty(), "no .{end} in {folder}");
    found.sort();
    found
}

#[test]
fn every_equation_of_the_thesis_has_its_place_or_a_reason() {
    let [sources, mathematics, differences] =
        ["sources", "mathematics", "differences"].map(|page| read(format!("docs/{page}.md")));
    let faults = faults_of_pages(&sources, &mathematics, &differences);
    assert!(faults.is_empty(), "{}", faults.join("\n"));

    // The check is able to fail: each edit of a page brings a fault.
    let row = sources.lines().find(|line| line.starts_with("| 2.40 ")).expect("a row");
    let twice = format!("{row}\n{row}");
    let elsewhere = row.replace("(14)", "(99)");
    for (from, to, fault) in [
        (row, "", "thesis 2.40 has 0 rows"),
        (row, &twice, "thesis 2.40 has 2 rows"),
        (row, &elsewhere, "there is no equation 99"),
        ("#four-nodes", "#camera", "(14) stands under \"Four nodes\""),
        ("[thesis 2.17]", "[ours: none]", "thesis: 17"),
        ("thesis 2.58, 2.63", "", "how thesis 2.58 is replaced"),
    ] {
        let [sources, mathematics, differences] =
            [&sources, &mathematics, &differences].map(|page| page.replace(from, to));
        let faults = faults_of_pages(&sources, &mathematics, &differences).join("\n");
        assert!(faults.contains(fault), "\"{fault}\" was not found: {faults}");
    }
}

#[test]
fn code_cites_equations_that_exist_and_the_thesis_beside_them() {
    let page = read("docs/mathematics.md");
    let equations = equations(&page);
    let mut cited: BTreeMap<u32, Vec<String>> =
        equations.keys().map(|&number| (number, Vec::new())).collect();
    let mut faults = Vec::new();
    for file in [files("src", "rs"), files("hdl-model/rtl", "sv")].concat() {
        let (numbers, wrong) = citations(&read(&file), &equations);
        for number in numbers {
            cited.get_mut(&number).unwrap().push(format!("`{}`", file.display()));
        }
        faults.extend(wrong.into_iter().map(|fault| format!("{}: {fault}", file.display())));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    for (number, files) in &cited {
        assert!(!files.is_empty(), "no file cites equation {number}");
    }

    let mut section = format!("{CITED}\n| equation | files |\n|---|---|\n");
    for (number, files) in &cited {
        let _ = writeln!(section, "| {number} | {} |", files.join(", "));
    }
    let start = page.find(CITED).expect("the section of citations");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        let page = format!("{}{section}", &page[..start]);
        std::fs::write(root().join("docs/mathematics.md"), page).expect("docs can be written");
    } else {
        assert!(
            page[start..] == section,
            "docs/mathematics.md does not list the files that cite its equations; run \
             `UPDATE_DOCS=1 cargo test --test sources`"
        );
    }
}

#[test]
fn wrong_citations_are_found() {
    let equations = equations(&read("docs/mathematics.md"));
    let faults = |source: &str| citations(source, &equations).1.join("; ");
    for right in [
        "//! Lerps (equation 14 of\n//! docs/mathematics.md; thesis 2.51, 2.52).",
        "    x, // equations 5 and 6; thesis 2.36, 2.37",
        "// (equations 14 to 16; thesis 2.51, 2.52,\n// 2.59 to 2.61)",
        "// Equation 7 is ours, equations have numbers.",
        "let header = \"equation 14\";",
    ] {
        assert_eq!(faults(right), "", "{right}");
    }
    for (wrong, fault) in [
        ("// (equation 14)", "thesis"),
        ("// (equation 14; thesis 2.50)", "thesis"),
        ("// (equation 7; thesis 2.50)", "thesis"),
        ("// (equation 99)", "no equation 99"),
        ("// (equations 30 to 99)", "no equation"),
        ("let header = \"equation 99\";", "no equation 99"),
        ("// thesis 2.64", "no thesis 2.64"),
    ] {
        assert!(faults(wrong).contains(fault), "{wrong}: {}", faults(wrong));
    }
}

#[test]
fn equations_of_registers_exist() {
    let equations = equations(&read("docs/mathematics.md"));
    for &register in Register::ALL {
        for number in table::row(register).equations.split(", ") {
            let number = number.parse().expect("a number");
            assert!(equations.contains_key(&number), "equation {number} of {register}");
        }
    }
}

#[test]
#[should_panic(expected = "no bracket under equation")]
fn an_equation_without_a_bracket_is_found() {
    equations("## A\n\n```math\nx \\tag{1}\n```\n\n```math\ny \\tag{2}\n```\n\n[thesis 2.1]\n");
}

#[test]
#[should_panic(expected = "no rows found")]
fn a_page_without_rows_is_found() {
    faults_of_pages("", "```math\nx \\tag{1}\n```\n\n[thesis 2.1]\n", "");
}
