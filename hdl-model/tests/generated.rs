//! The files of `rtl/` that are generated from Rust are those that the tables give.

use std::path::Path;

#[test]
fn generated_files_are_current() {
    for (file, text) in terraline_hdl::cli::generated() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
        let found = std::fs::read_to_string(&path).expect("the file is there");
        assert!(
            found == text,
            "{file} is not what the tables say; run `cargo run -p terraline-hdl -- generate`"
        );
    }
}
