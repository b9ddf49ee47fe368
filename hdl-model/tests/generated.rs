//! The files of `rtl/` that are generated from Rust are those that the tables give.

#[test]
fn generated_files_are_current() {
    for (path, text) in terraline_hdl::cli::generated() {
        let found = std::fs::read_to_string(&path).expect("the file is there");
        assert!(
            found == text,
            "{} is not what the tables say; run `cargo run -p terraline-hdl -- generate`",
            path.display()
        );
    }
}
