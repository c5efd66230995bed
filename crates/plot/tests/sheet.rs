//! The drawing from outside: what a caller puts in and what the picture must show.

use plot::{Arc, Drawing, Kind, Layer, Mark, MarkKind, Plane, PngError, Stroke, Title};
use resvg::usvg;

fn drawing() -> Drawing {
    Drawing::new(Title { program: "O1000".to_owned(), control: "control".to_owned(), machine: "machine".to_owned() })
}

fn line(kind: Kind, from: [f64; 3], to: [f64; 3]) -> Stroke {
    Stroke { kind, from, to, arc: None, feed: 500.0, tool: 1 }
}

/// A square of 100 mm side whose tool comes from and returns to a far reference point.
fn square() -> Drawing {
    let mut drawing = drawing();
    let corners = [[500.0, 300.0], [600.0, 300.0], [600.0, 400.0], [500.0, 400.0], [500.0, 300.0]];
    drawing.stroke(&line(Kind::Rapid, [0.0; 3], [500.0, 300.0, -200.0]));
    for pair in corners.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|[x, y]| [x, y, -200.0]);
        drawing.stroke(&line(Kind::Feed, from, to));
    }
    drawing.stroke(&line(Kind::Rapid, [500.0, 300.0, -200.0], [0.0; 3]));
    drawing
}

/// The sheet as an SVG reader understands it; an error if it is not well-formed.
fn tree(svg: &str) -> Result<usvg::Tree, usvg::Error> {
    usvg::Tree::from_str(svg, &usvg::Options::default())
}

/// The number of times a text occurs.
fn count(svg: &str, text: &str) -> usize {
    svg.matches(text).count()
}

#[test]
fn rapids_that_leave_are_cut_at_the_panel_and_said_in_words() {
    let svg = square().svg();
    assert!(svg.contains("Rapids leave the picture: to X 0 Y 0 Z 0 (mm)."), "{svg}");
    let tree = tree(&svg).expect("well-formed");
    let (sheet, drawn) = (tree.size(), tree.root().abs_stroke_bounding_box());
    assert!(drawn.left() >= 0.0 && drawn.top() >= 0.0);
    assert!(drawn.right() <= sheet.width() && drawn.bottom() <= sheet.height(), "{drawn:?} on {sheet:?}");
}

#[test]
fn the_header_gives_extents_and_lengths() {
    let svg = square().svg();
    assert!(svg.contains("X 500 \u{2026} 600"), "{svg}");
    assert!(svg.contains("cutting path 400 mm") && svg.contains("T1"), "{svg}");
}

#[test]
fn if_nothing_cuts_everything_is_in_the_frame() {
    let mut drawing = drawing();
    drawing.stroke(&line(Kind::Rapid, [0.0; 3], [-800.0, -500.0, -300.0]));
    drawing.stroke(&line(Kind::Rapid, [-800.0, -500.0, -300.0], [-10.0, 0.0, 0.0]));
    let svg = drawing.svg();
    assert!(!svg.contains("leave the picture") && svg.contains("rapid path"), "{svg}");
}

#[test]
fn a_full_circle_is_exact_in_both_views() {
    let mut drawing = drawing();
    let arc = Some(Arc { plane: Plane::Xy, center: [0.0, 0.0], sweep_deg: 360.0 });
    drawing.stroke(&Stroke { arc, ..line(Kind::Feed, [50.0, 0.0, 0.0], [50.0, 0.0, 0.0]) });
    let svg = drawing.svg();
    // Four elliptical parts in each view, the first command followed by three more pairs of flags.
    assert_eq!(count(&svg, " 0 0 0"), 8, "{svg}");
    assert!(svg.contains("X \u{2212}50 \u{2026} 50") && svg.contains("cutting path 314 mm"), "{svg}");
}

#[test]
fn a_helix_is_round_in_plan_and_flattened_in_the_isometric_view() {
    let mut drawing = drawing();
    let arc = Some(Arc { plane: Plane::Xy, center: [0.0, 0.0], sweep_deg: -360.0 });
    drawing.stroke(&Stroke { arc, ..line(Kind::Feed, [50.0, 0.0, 0.0], [50.0, 0.0, -10.0]) });
    assert_eq!(count(&drawing.svg(), " 0 0 1"), 4);
}

#[test]
fn what_is_not_a_number_draws_nothing() {
    let mut with = square();
    for bad in [f64::NAN, f64::INFINITY, -1e300] {
        with.stroke(&line(Kind::Feed, [bad, 0.0, 0.0], [1.0, 1.0, 1.0]));
        with.stroke(&line(Kind::Rapid, [0.0; 3], [0.0, bad, 0.0]));
        let arc = Some(Arc { plane: Plane::Yz, center: [0.0, bad], sweep_deg: 90.0 });
        with.stroke(&Stroke { arc, ..line(Kind::Feed, [0.0; 3], [1.0; 3]) });
        with.mark(Mark { at: [0.0, 0.0, bad], kind: MarkKind::Alarm, text: String::new() });
    }
    assert_eq!(with.svg(), square().svg());
    // A feed that is no number still draws its stroke.
    let mut drawing = drawing();
    drawing.stroke(&Stroke { feed: f64::NAN, ..line(Kind::Feed, [0.0; 3], [9.0; 3]) });
    assert!(drawing.svg().contains("feed 0 mm/min"));
}

#[test]
fn strange_extents_do_not_break_the_sheet() {
    for [from, to] in [
        [[0.0; 3], [1e-9, 0.0, 0.0]],
        [[0.0; 3], [1e9, 0.0, 0.0]],
        [[-1e9; 3], [1e9; 3]],
        [[5.0, 5.0, 0.0], [5.0, 5.0, -30.0]],
        [[1e9, 1e9, 1e9], [1e9, 1e9, 1e9 - 1e-6]],
    ] {
        for kind in [Kind::Rapid, Kind::Feed] {
            let mut drawing = drawing();
            drawing.stroke(&line(kind, from, to));
            let svg = drawing.svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            tree(&svg).expect("well-formed");
        }
    }
    tree(&drawing().svg()).expect("well-formed");
}

#[test]
fn text_from_outside_is_escaped() {
    let mut drawing = Drawing::new(Title {
        program: "<script>&\"'\u{0}".to_owned(),
        control: "]]>".to_owned(),
        machine: "Drehmaschine Größe 2".to_owned(),
    });
    drawing.stroke(&line(Kind::Feed, [0.0; 3], [10.0, 10.0, 0.0]));
    drawing.mark(Mark { at: [5.0, 5.0, 0.0], kind: MarkKind::Stop, text: "</text><b>".to_owned() });
    let svg = drawing.svg();
    tree(&svg).expect("well-formed");
    assert!(svg.contains("&lt;script&gt;&amp;") && svg.contains("&lt;/text&gt;") && !svg.contains("<b>"), "{svg}");
}

#[test]
fn few_feeds_are_named_and_many_have_a_scale() {
    let mut drawing = drawing();
    let cut = |drawing: &mut Drawing, feed: f64| {
        drawing.stroke(&Stroke { feed, ..line(Kind::Feed, [0.0, feed, 0.0], [50.0, feed, 0.0]) });
    };
    for feed in [100.0, 200.0, 300.0, 400.0, 500.0, 650.5] {
        cut(&mut drawing, feed);
    }
    let few = drawing.svg();
    assert!(few.contains("feed 100 mm/min") && few.contains("feed 650.5 mm/min"), "{few}");
    cut(&mut drawing, 4000.0);
    let many = drawing.svg();
    assert!(many.contains("feed 100 \u{2026} 4000 mm/min") && !many.contains("feed 200 mm/min"), "{many}");
}

#[test]
fn marks_are_signs_with_labels_or_said_to_be_outside() {
    let mut drawing = square();
    let mark = |at, kind, text: &str| Mark { at, kind, text: text.to_owned() };
    drawing.mark(mark([0.0; 3], MarkKind::ToolChange(7), ""));
    drawing.mark(mark([550.0, 350.0, -200.0], MarkKind::Alarm, "alarm 2041"));
    let svg = drawing.svg();
    assert!(svg.contains("Outside the picture: T7 at X 0 Y 0 Z 0."), "{svg}");
    assert_eq!(count(&svg, ">alarm 2041<"), 2, "beside its sign in both views");
    assert!(svg.contains(">alarm<") && !svg.contains(">tool change<"), "the legend names what is seen");
}

#[test]
fn a_drilled_hole_is_seen_in_plan() {
    let mut drawing = drawing();
    drawing.stroke(&line(Kind::Rapid, [0.0, 0.0, 5.0], [40.0, 20.0, 5.0]));
    drawing.stroke(&line(Kind::Feed, [40.0, 20.0, 5.0], [40.0, 20.0, -20.0]));
    drawing.stroke(&line(Kind::Rapid, [40.0, 20.0, -20.0], [40.0, 20.0, 5.0]));
    assert!(drawing.svg().contains("drilled hole"));
}

/// Rows of short strokes over a wavy surface, to and fro.
fn surface(rows: usize, columns: usize) -> Drawing {
    let mut drawing = drawing();
    let mut last: Option<[f64; 3]> = None;
    for row in 0..rows {
        for column in 0..columns {
            let column = if row % 2 == 0 { column } else { columns - 1 - column };
            let [x, y] = [column as f64 / columns as f64 * 200.0, row as f64 / rows as f64 * 150.0];
            let to = [x, y, 8.0 * (x / 13.0).sin() * (y / 17.0).cos()];
            if let Some(from) = last {
                drawing.stroke(&line(Kind::Feed, from, to));
            }
            last = Some(to);
        }
    }
    drawing
}

#[test]
fn a_million_strokes_are_a_small_picture() {
    let svg = surface(1000, 1000).svg();
    assert!(svg.len() < 8_000_000, "{} bytes", svg.len());
    assert!(!svg.contains("drawn to within"), "the coarsening is not visible");
    tree(&svg).expect("well-formed");
}

#[test]
fn a_million_strokes_without_any_order_are_still_bounded() {
    let mut drawing = drawing();
    let mut seed = 1_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 40) as f64 / 1e5
    };
    let mut from = [0.0; 3];
    for nth in 0..1_000_000 {
        let to = [next(), next(), next()];
        drawing.stroke(&Stroke { feed: f64::from(nth % 977), ..line(Kind::Feed, from, to) });
        from = to;
    }
    let svg = drawing.svg();
    assert!(svg.len() < 8_000_000, "{} bytes", svg.len());
    assert!(svg.contains("drawn to within"), "what cannot be shown exactly is said");
}

#[test]
fn the_same_strokes_give_the_same_bytes() {
    assert_eq!(square().svg(), square().svg());
    assert_eq!(surface(40, 40).png(300).expect("a picture"), surface(40, 40).png(300).expect("a picture"));
}

#[test]
fn a_png_is_as_wide_as_asked_and_not_empty() {
    for width in [700, 1601] {
        let bytes = square().png(width).expect("a picture");
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
        assert_eq!(reader.info().width, width);
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut pixels).expect("pixels");
        let dark = pixels.chunks(4).filter(|pixel| pixel[0] < 100).count();
        assert!(dark > width as usize / 10, "{dark} dark pixels: text and lines are drawn");
    }
    assert!(matches!(square().png(0), Err(PngError::Width(0))));
    assert!(matches!(square().png(1 << 20), Err(PngError::Width(_))));
}

/// A square of 40 mm side, and a tool of 5 mm that runs outside it.
fn beside(layers: &[Layer], plane: Plane) -> Drawing {
    let mut drawing = drawing();
    drawing.show(layers);
    let square = |half: f64| [[-half, -half], [-half, half], [half, half], [half, -half], [-half, -half]];
    for (way, run) in square(20.0).windows(2).zip(square(25.0).windows(2)) {
        let stroke = |ends: &[[f64; 2]]| line(Kind::Feed, [ends[0][0], ends[0][1], 0.0], [ends[1][0], ends[1][1], 0.0]);
        drawing.stroke(&stroke(run));
        drawing.swept(&stroke(run), plane, 5.0);
        drawing.programmed(&stroke(way));
    }
    drawing
}

#[test]
fn the_layers_that_are_drawn_stand_in_the_legend_and_no_others() {
    let all = [Layer::Programmed, Layer::Compensated, Layer::Tool];
    let names = ["programmed contour", "feed 500 mm/min", "swept by the tool"];
    for chosen in 0..8 {
        let is_chosen = |layer: usize| chosen >> layer & 1 == 1;
        let layers: Vec<_> = (0..3).filter(|layer| is_chosen(*layer)).map(|layer| all[layer]).collect();
        let svg = beside(&layers, Plane::Xy).svg();
        for (layer, name) in names.iter().enumerate() {
            assert_eq!(count(&svg, name), usize::from(is_chosen(layer)), "{layers:?}: {name}");
        }
        tree(&svg).expect("well-formed");
    }
}

#[test]
fn the_path_alone_is_drawn_as_if_there_were_no_layers() {
    let mut alone = drawing();
    let run = [[-25.0, -25.0], [-25.0, 25.0], [25.0, 25.0], [25.0, -25.0], [-25.0, -25.0]];
    for ends in run.windows(2) {
        alone.stroke(&line(Kind::Feed, [ends[0][0], ends[0][1], 0.0], [ends[1][0], ends[1][1], 0.0]));
    }
    assert_eq!(beside(&[Layer::Compensated], Plane::Xy).svg(), alone.svg());
}

#[test]
fn the_tool_is_as_large_as_it_is_and_stays_in_the_picture() {
    let svg = beside(&[Layer::Compensated, Layer::Tool], Plane::Xy).svg();
    let of = |name: &str, behind: &str| -> f64 {
        let from = svg.find(behind).expect("drawn");
        let text = &svg[from..][svg[from..].find(name).expect("with this attribute") + name.len()..];
        text[..text.find('"').expect("closed")].parse().expect("a number")
    };
    let radius = of("r=\"", "<circle");
    assert!((of("stroke-width=\"", "stroke-linecap=\"round\" stroke-linejoin") - 2.0 * radius).abs() < 0.02, "{svg}");
    // Four corners and the legend's own.
    assert_eq!(count(&svg, "<circle"), 5);
    // The square that it sweeps, 60 mm wide, fills the plan but for its inset.
    assert!(radius > 20.0 && svg.contains("tool, radius 5 mm"), "{radius}");
}

#[test]
fn a_tool_of_another_plane_is_told_in_words() {
    let svg = beside(&[Layer::Compensated, Layer::Tool], Plane::Zx).svg();
    assert!(svg.contains("only where it is compensated in the XY plane") && !svg.contains("swept"), "{svg}");
}

#[test]
fn what_the_tool_does_not_fit_beside_is_red_whatever_is_drawn() {
    for layers in [&[][..], &[Layer::Compensated], &[Layer::Programmed]] {
        let mut drawing = beside(layers, Plane::Xy);
        let way = line(Kind::Feed, [0.0, 20.0, 0.0], [4.0, 20.0, 0.0]);
        drawing.refused(&way, Plane::Xy, [2.0, 25.0, 0.0], 5.0);
        let svg = drawing.svg();
        assert!(svg.contains("refused: the tool does not fit beside it"), "{svg}");
        // In plan with the tool, which is in the legend too.
        assert_eq!(count(&svg, "<circle"), 2);
        tree(&svg).expect("well-formed");
    }
}
