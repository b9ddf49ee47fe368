use glam::*;
use std::sync::Arc;
use terraline::{plan::Plan, scene::*, setup::*, *};
fn scene(eye: DVec3, fwd: DVec3, n: u32) -> Scene {
    let img = image::open("assets/jacksboro.png").unwrap().into_luma16();
    let map = HeightMap::new(344, 344, img.pixels().map(|p| p.0[0] as f32).collect());
    Scene {
        name: "t".into(),
        unit_m: 80.,
        seed: 1,
        camera: Camera {
            position: eye,
            offset: DVec3::ZERO,
            attitude: Attitude::Directions { forward: fwd, up: DVec3::Y },
        },
        screens: vec![Screen {
            name: "front".into(),
            columns: n,
            lines: n,
            extent: Extent::FieldOfView(60f64.to_radians()),
            center: DVec2::ZERO,
            mount: Angles::default(),
        }],
        surface: Surface::Terrain(Terrain {
            source: "".into(),
            map: Arc::new(map),
            cell: DVec2::ONE,
            offset: 236.,
            scale: 0.025,
            outside: Outside::Sky,
            base_depth: None,
        }),
        kernel: Kernel {
            shape: KernelShape::Cosine,
            deformation: Deformation::Blend { weight_shift: 2 },
            table: 4096,
        },
        stepper: Stepper {
            mode: StepperMode::Skipping,
            fineness: 3,
            halvings: Halvings::Footprint,
        },
        light: Light { direction: DVec3::new(-1., 1.5, -1.).normalize(), ambient: 0.3 },
        color: Colors {
            ramp: vec![[0, 0, 255], [255, 0, 0]],
            sky: [160, 190, 220],
            far: [160, 190, 220],
            side: [96, 82, 64],
            checker: [[200, 200, 190], [70, 90, 70]],
        },
        machine: Machine { clock_mhz: 100., memory_latency: 2, words: WordSize::Auto },
        formats: vec![],
    }
}
fn main() {
    let n: u32 = std::env::args().nth(1).map_or(1024, |s| s.parse().unwrap());
    for (name, e, f) in [
        ("overview", DVec3::new(172., 192., -12.), DVec3::new(0., -0.7071, 0.7071)),
        ("flight", DVec3::new(300., 30., 330.), DVec3::new(-0.5868, -0.2079, -0.7824)),
        ("valley", DVec3::new(232., 3.2, 168.), DVec3::new(-105., 0., -150.)),
    ] {
        let s = scene(e, f, n);
        let p = Plan::new(&s, None, false).unwrap();
        println!("{name}: {} {:?}", p.words_why(), p.ground);
        let w = word::stock::Narrow;
        let m = Memory::new(&w, &s, &p).unwrap();
        let t = std::time::Instant::now();
        let setup = Setup::new(w, &s, &p, m.as_ref()).unwrap();
        let mut fr = fast::render(&setup, &p, false);
        for _ in 0..4 {
            let t = std::time::Instant::now();
            fr = fast::render(&setup, &p, false);
            println!("{:?}", t.elapsed());
        }
        println!("{:?}", t.elapsed());
        let mut pr = readout::FrameBuilder::new(&p, n as usize, false, false);
        let mut line = processor::Processor::new(&setup).wires();
        let (mut tr, mut sa, mut ha) = (0u64, 0u64, 0u64);
        let t = std::time::Instant::now();
        processor::run_lines(&setup, &mut line, 0..n, |l| {
            pr.push(l);
            for w in &l.work {
                tr += w.trials as u64;
                sa += w.samples as u64;
                ha += w.halvings as u64;
            }
        });
        println!("proc {:?}", t.elapsed());
        let px = (n * n) as f64;
        println!(
            "trials {} samples {} halvings {} equal {}",
            tr as f64 / px,
            sa as f64 / px,
            ha as f64 / px,
            pr.finish() == fr
        );
        let raw: Vec<u8> = fr.color.iter().flatten().copied().collect();
        image::RgbImage::from_raw(n, n, raw).unwrap().save(format!("/tmp/{name}.png")).unwrap();
    }
}
