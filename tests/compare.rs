//! Pictures and buffers compared, in memory and as files.

mod samples;

use samples::{folder, frame, image, write_image};
use terraline::sink::npz;
use terraline::sink::png::Image;
use terraline::study::compare::{
    Comparison, compare_files, compare_pictures, difference_picture, gain,
};

#[test]
fn pictures_are_compared() {
    let a = image(40, 30);
    let same = compare_pictures(&a, &a).unwrap();
    assert!(same.identical && same.psnr_db.is_infinite() && same.first.is_none());
    assert_eq!((same.max_difference, same.rms, same.ssim), (0, 0.0, Some(1.0)));
    assert_eq!(same.to_string(), "40 x 30 pixels: identical");
    let json = serde_json::to_value(Comparison::Picture(same)).unwrap();
    assert!(json["psnr_db"].is_null() && json["identical"] == true && json["kind"] == "picture");

    let mut b = a.clone();
    b.pixels[45] = [250, 9, 239]; // 45, 9, 239
    b.pixels[90] = [90, 18, 0]; // 90, 18, 222
    let found = compare_pictures(&a, &b).unwrap();
    assert_eq!((found.differing_pixels, found.max_difference), (2, 222));
    assert!((found.differing_share - 2.0 / 1200.0).abs() < 1e-15);
    let mean = (205.0_f64 * 205.0 + 222.0 * 222.0) / 3600.0;
    assert!((found.rms - mean.sqrt()).abs() < 1e-12);
    assert!((found.psnr_db - 10.0 * (255.0 * 255.0 / mean).log10()).abs() < 1e-9);
    let (first, worst) = (found.first.unwrap(), found.worst.unwrap());
    assert_eq!((first.column, first.line, first.difference), (5, 1, 205));
    assert_eq!((worst.column, worst.line, worst.b), (10, 2, [90, 18, 0]));
    let text = found.to_string();
    assert!(text.contains("worst: column 10, line 2: [90, 18, 222] and [90, 18, 0]"), "{text}");
    let found = Comparison::Picture(found);
    assert!(found.is_within(222.0) && !found.is_within(221.0));

    let difference = difference_picture(&a, &b, 2).unwrap();
    assert_eq!(difference.pixels[45], [255, 0, 0]);
    assert_eq!(difference.pixels[0], [0; 3]);
    assert_eq!([0, 1, 3, 100, 127, 128, 255].map(gain), [1, 255, 85, 2, 2, 1, 1]);

    compare_pictures(&a, &image(30, 40)).unwrap_err();
    difference_picture(&a, &image(30, 40), 1).unwrap_err();
    let small =
        compare_pictures(&image(10, 40), &Image { pixels: vec![[0; 3]; 400], ..image(10, 40) });
    let small = small.unwrap();
    assert_eq!(small.ssim, None);
    assert!(small.to_string().contains("SSIM: none"));
}

#[test]
fn mean_squares_agree_with_scikit_image() {
    // 100 + c against 101 + c + (column + line) % 2; values of scikit-image 0.26.0.
    let level = |base: u8, odd: bool| {
        let pixel =
            |i: usize| [0, 1, 2].map(|c| base + c + u8::from(odd && (i % 11 + i / 11) % 2 == 1));
        Image { columns: 11, lines: 11, pixels: (0..121).map(pixel).collect() }
    };
    let found = compare_pictures(&level(100, false), &level(101, true)).unwrap();
    assert!((found.rms - 1.5772137793543157).abs() < 1e-12);
    assert!((found.psnr_db - 44.172992355905166).abs() < 1e-9);
    assert!((found.ssim.unwrap() - 0.9956381276101318).abs() < 1e-11);
}

#[test]
fn buffers_are_compared() {
    let folder = folder();
    let (one, two) = (folder.path().join("one.npz"), folder.path().join("two.data"));
    let mut changed = frame(150, 120);
    npz::write(&one, &changed).unwrap();
    npz::write(&two, &changed).unwrap();
    let same = compare_files(&one, &two).unwrap();
    assert!(same.is_within(0.0) && same.to_string().starts_with("identical\nhit: identical"));

    let buffers = changed.buffers.as_mut().unwrap();
    buffers.normal[17_000][1] += 0.5;
    buffers.normal[150][2] -= 0.25;
    buffers.height[151] = 3.0;
    buffers.height[1] = 2.0; // was NaN
    buffers.trials.clear();
    npz::write(&two, &changed).unwrap();
    let found = compare_files(&one, &two).unwrap();
    assert!(!found.is_within(1e300), "a height is NaN on one side only");
    let text = found.to_string();
    assert!(text.contains("trials: only in the first, which no --max-diff counts"), "{text}");
    let Comparison::Buffers(found) = found else { panic!("buffers") };
    assert!(!found.identical && found.only_in_b.is_empty());
    assert_eq!(found.only_in_a, ["trials"]);
    let named = |name: &str| found.arrays.iter().find(|array| array.name == name).unwrap();
    let normal = named("normal");
    assert_eq!((normal.differing, normal.unmatched, normal.elements), (2, 0, 54_000));
    assert!((normal.max_difference - 0.5).abs() < 1e-9);
    assert!((normal.rms - (0.3125_f64 / 54_000.0).sqrt()).abs() < 1e-9);
    assert_eq!(normal.first, Some(vec![1, 0, 2]));
    assert_eq!(normal.worst, Some(vec![113, 50, 1]));
    let height = named("height");
    assert_eq!((height.differing, height.unmatched), (2, 1));
    let apart = 151.0 / 7.0 * 1e12 - 3.0;
    assert!((height.max_difference / apart - 1.0).abs() < 1e-12);
    assert!((height.rms / (apart / 17_999_f64.sqrt()) - 1.0).abs() < 1e-12, "{}", height.rms);
    assert_eq!((&height.first, &height.worst), (&Some(vec![0, 1]), &Some(vec![1, 1])));
    assert_eq!(named("lambda").differing, 0);

    let mut fast = frame(150, 120);
    fast.buffers.as_mut().unwrap().trials.clear();
    npz::write(&two, &fast).unwrap();
    let found = compare_files(&one, &two).unwrap();
    assert!(found.is_within(0.0), "skip tests are the processor's alone: {found}");
    fast.buffers = None;
    npz::write(&two, &fast).unwrap();
    let found = compare_files(&one, &two).unwrap();
    let beyond = found.beyond(1e300).join(", ");
    assert!(beyond.contains("height is only in the first"), "arrays are missing: {beyond}");
    assert!(!beyond.contains("trials"), "{beyond}");

    npz::write(&two, &frame(120, 150)).unwrap();
    let error = compare_files(&one, &two).unwrap_err().to_string();
    assert!(error.contains("`hit`") && error.contains("[120, 150]"), "{error}");
    let picture = folder.path().join("frame.png");
    write_image(&picture, &image(4, 4));
    let error = compare_files(&picture, &one).unwrap_err().to_string();
    assert!(error.contains("one is a picture"), "{error}");
    let json = serde_json::to_value(compare_files(&picture, &picture).unwrap()).unwrap();
    assert!(json["ssim"].is_null() && json["columns"] == 4);
    compare_files(&picture, &folder.path().join("none.png")).unwrap_err();
}

#[test]
fn one_pixel_far_off_does_not_darken_the_difference() {
    let a = image(40, 30);
    let mut b = a.clone();
    for pixel in &mut b.pixels[..100] {
        pixel[1] = pixel[1].wrapping_add(2);
    }
    b.pixels[500] = b.pixels[500].map(|channel| channel ^ 0x80);
    let found = compare_pictures(&a, &b).unwrap();
    assert_eq!((found.max_difference, found.p95_difference), (128, 2));
    let picture = difference_picture(&a, &b, gain(found.p95_difference)).unwrap();
    assert_eq!((picture.pixels[3], picture.pixels[500]), ([0, 254, 0], [255; 3]));
    // Of 101 pixels that differ 96 are 95 %.
    for pixel in &mut b.pixels[..6] {
        *pixel = [a.pixels[0][0] ^ 0x80, 0, 0];
    }
    assert!(compare_pictures(&a, &b).unwrap().p95_difference > 2);
}
