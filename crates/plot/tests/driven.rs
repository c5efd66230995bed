//! Pictures of how the axes move, from outside: real speeds, deviations, charts.

use plot::{Arc, Chart, ChartAxis, Drawing, Kind, Layer, Look, Plane, Stroke, Title};
use proptest::prelude::*;
use resvg::usvg;

fn title() -> Title {
    Title { program: "O1000".to_owned(), control: "control".to_owned(), machine: "machine".to_owned() }
}

fn cut(from: [f64; 3], to: [f64; 3], feed: f64) -> Stroke {
    Stroke { kind: Kind::Feed, from, to, arc: None, feed, tool: 1 }
}

/// Fails if an SVG reader does not understand the sheet.
fn assert_well_formed(svg: &str) {
    assert!(usvg::Tree::from_str(svg, &usvg::Options::default()).is_ok(), "{svg}");
}

/// A corner at (100, 0) of which a chamfer `off` mm from it is driven; up along Y or along Z.
fn corner(off: f64, up: usize, show: impl FnOnce(&mut Drawing)) -> String {
    let mut drawing = Drawing::new(title());
    drawing.show(&[Layer::Programmed, Layer::Actual]);
    show(&mut drawing);
    let at = |along: f64, above: f64| {
        let mut at = [along, 0.0, 0.0];
        at[up] = above;
        at
    };
    let ways = [cut(at(0.0, 0.0), at(100.0, 0.0), 500.0), cut(at(100.0, 0.0), at(100.0, 100.0), 500.0)];
    let chamfer = |part: f64| at(100.0 - 2.0 * off * (1.0 - part), 2.0 * off * part);
    let before = vec![at(0.0, 0.0), chamfer(0.0), chamfer(0.3)];
    for (way, driven) in ways.iter().zip([before, vec![chamfer(0.3), chamfer(0.8), chamfer(1.0), at(100.0, 100.0)]]) {
        drawing.stroke(way);
        drawing.ordered(way);
        drawing.driven(Kind::Feed, &driven);
        drawing.commanded(way);
    }
    let svg = drawing.svg();
    assert_well_formed(&svg);
    svg
}

#[test]
fn a_deviation_too_small_to_be_seen_is_drawn_larger_beside_the_plan() {
    // The middle of the chamfer is 0.01 mm from either way, between two places that the axes were told.
    let svg = corner(0.01, 1, |_| ());
    assert!(
        svg.contains("The driven path is at most 0.0100 mm from the commanded one, at X 99.99 Y 0.01 Z 0."),
        "{svg}"
    );
    assert!(svg.contains(">In the circle<") && !svg.contains("Isometric"), "{svg}");
    assert!(svg.contains("largest deviation, 0.0100 mm, at the right ") && svg.contains("<circle"), "{svg}");
    assert!(!svg.contains("Too little to be seen"), "{svg}");
}

#[test]
fn a_deviation_that_is_seen_needs_no_enlarging() {
    let svg = corner(4.0, 1, |_| ());
    assert!(svg.contains("at most 4.00 mm from") && svg.contains("Isometric") && !svg.contains("<circle"), "{svg}");
}

#[test]
fn what_is_off_along_z_is_enlarged_in_the_isometric_view() {
    let svg = corner(0.01, 2, |_| ());
    assert!(svg.contains(">In the circle<") && svg.contains("Z mm") && !svg.contains("Isometric"), "{svg}");
}

#[test]
fn a_plan_alone_says_how_the_deviation_is_seen() {
    let svg = corner(0.012, 1, |drawing| drawing.look(Look::Plan));
    assert!(
        svg.contains("It is seen with --around 99.988,0.012,0.5 or, drawn larger everywhere, with --exaggerate "),
        "{svg}"
    );
    let svg = corner(0.012, 1, |drawing| {
        drawing.look(Look::Plan);
        drawing.exaggerate(500.0);
    });
    assert!(svg.contains("its deviation drawn 500 times as large") && !svg.contains("Too little"), "{svg}");
    assert!(svg.contains("at most 0.0120 mm from"), "it is stated as it is: {svg}");
}

/// The greatest number in the paths of a picture.
fn farthest_coordinate(svg: &str) -> f64 {
    let data = svg.split(" d=\"").skip(1).filter_map(|part| part.split('"').next());
    let numbers = data.flat_map(|d| d.split(|sign: char| !(sign.is_ascii_digit() || ".-".contains(sign))));
    numbers.filter_map(|number| number.parse::<f64>().ok()).fold(0.0, |most, number| most.max(number.abs()))
}

#[test]
fn a_window_on_a_micrometre_is_drawn_with_coordinates_that_every_reader_can_tell_apart() {
    let around = |drawing: &mut Drawing| {
        drawing.look(Look::Around([99.9995, 0.0005], 0.002));
        let arc = Arc { plane: Plane::Xy, center: [100.0, 50.0], sweep_deg: 360.0 };
        drawing.programmed(&Stroke { arc: Some(arc), ..cut([100.0, 0.0, 0.0], [100.0, 0.0, 0.0], 500.0) });
    };
    let farthest = farthest_coordinate(&corner(0.0005, 1, around));
    assert!((900.0..1600.0).contains(&farthest), "the sheet is 1000 wide: {farthest}");
}

#[test]
fn real_speeds_are_coloured_from_rest_to_the_fastest_in_equal_steps() {
    let mut drawing = Drawing::new(title());
    drawing.show(&[Layer::Speed]);
    for (nth, speed) in [0.0, 1500.0, 3000.0].into_iter().enumerate() {
        let x = nth as f64 * 10.0;
        drawing.stroke(&cut([x, 0.0, 0.0], [x + 10.0, 5.0, 0.0], speed));
    }
    let svg = drawing.svg();
    assert_well_formed(&svg);
    assert!(svg.contains("real speed, mm/min") && svg.contains(">3000</text>") && !svg.contains("feed "), "{svg}");
    // Viridis at rest, in the middle (16 of 31 steps) and at the end.
    for colour in ["#440154", "#297b8e", "#7ad151"] {
        assert_eq!(svg.matches(&format!("stroke=\"{colour}\"")).count(), 2, "one line in either view, {colour}: {svg}");
    }
}

fn chart(axes: &[(char, bool)]) -> Chart {
    Chart::new(title(), axes.iter().map(|(letter, turns)| ChartAxis { letter: *letter, turns: *turns }))
}

/// The least Y of the paths of a colour: the top of a line.
fn top(svg: &str, stroke: &str) -> f64 {
    let group = &svg[svg.find(stroke).expect("it is drawn")..];
    let d = group.split(" d=\"").nth(1).and_then(|part| part.split('"').next()).expect("a path");
    let (mut y, mut least) = (0.0, f64::INFINITY);
    for part in d.split_inclusive(|sign: char| sign.is_ascii_alphabetic()).collect::<Vec<_>>().windows(2) {
        let absolute = part[0].ends_with(['M', 'L']);
        let numbers = part[1].trim_end_matches(|sign: char| sign.is_ascii_alphabetic()).replace('-', " -");
        let numbers: Vec<f64> = numbers.split_whitespace().map(|number| number.parse().expect("a number")).collect();
        for pair in numbers.chunks(2) {
            y = if absolute { pair[1] } else { y + pair[1] };
            least = f64::min(least, y);
        }
    }
    least
}

#[test]
fn the_top_of_a_chart_is_the_feed_that_is_reached() {
    let mut chart = chart(&[('X', false), ('B', true), ('Z', false)]);
    chart.begin(Kind::Feed, [0.0, 4.0]);
    chart.commanded([0.0, 4.0], 1200.0);
    for (time, speed) in [(0.0, 0.0), (1.0, 1200.0), (3.0, 1200.0), (4.0, 0.0)] {
        chart.moves(Kind::Feed, time, speed, &[speed, -speed / 2.0, 0.0]);
    }
    chart.block(7, 4.0);
    let svg = chart.svg();
    assert_well_formed(&svg);
    let [speed, commanded] = ["stroke=\"#2a788e\"", "stroke-dasharray=\"8 5\""].map(|stroke| top(&svg, stroke));
    assert!((speed - commanded).abs() < 0.011, "{speed} {commanded}: {svg}");
    assert!(svg.contains("fastest cut 1200 mm/min") && svg.contains("cutting 4.000 s"), "{svg}");
    assert!(svg.contains(">7</text>") && svg.contains(">B</text>") && svg.contains("\u{b0}/min"), "{svg}");
    assert!(!svg.contains(">Z</text>"), "an axis that stands has no panel: {svg}");
}

#[test]
fn blocks_that_follow_each_other_within_rounding_do_not_stop_in_a_chart() {
    let mut chart = chart(&[('X', false)]);
    // Sums of times differ by their last digit.
    for (from, to) in [(0.0, 8.0), (8.0 + 1e-14, 16.0)] {
        chart.begin(Kind::Feed, [from, to]);
        chart.moves(Kind::Feed, from, 600.0, &[600.0]);
        chart.moves(Kind::Feed, to - 1e-14, 600.0, &[600.0]);
        chart.block(1, to);
    }
    let svg = chart.svg();
    let group = &svg[svg.find("stroke=\"#2a788e\" stroke-width=\"2\"").expect("drawn")..];
    let line = group.split(" d=\"").nth(1).and_then(|part| part.split('"').next()).expect("a path");
    assert_eq!(line.matches(' ').count(), 2, "a level line from end to end: {line}");
}

#[test]
fn a_chart_of_very_many_blocks_names_the_lines_at_round_times() {
    let mut chart = chart(&[('X', false)]);
    for block in 0..200_000u32 {
        let times = [f64::from(block), f64::from(block) + 1.0];
        chart.begin(Kind::Feed, times);
        chart.moves(Kind::Feed, times[0], 100.0, &[f64::from(block % 3)]);
        chart.moves(Kind::Feed, times[1], 100.0, &[f64::from(block % 3)]);
        chart.block(u64::from(block) + 1, times[1]);
    }
    let svg = chart.svg();
    assert_well_formed(&svg);
    assert!(svg.len() < 3_000_000, "{}", svg.len());
    assert!(svg.contains(">1</text>") && svg.contains("The program is long"), "the first line is at time 0");
}

#[test]
fn rapids_many_times_as_fast_as_the_feed_leave_the_chart_and_are_said_in_words() {
    let sheet = |rapid: f64| {
        let mut chart = chart(&[('X', false)]);
        for (nth, (kind, speed)) in [(Kind::Rapid, rapid), (Kind::Feed, 300.0)].into_iter().enumerate() {
            let from = nth as f64;
            chart.begin(kind, [from, from + 1.0]);
            chart.moves(kind, from, speed, &[speed]);
            chart.moves(kind, from + 1.0, speed, &[speed]);
            chart.block(nth as u64, from + 1.0);
        }
        chart.svg()
    };
    let near = sheet(600.0);
    assert!(near.contains(">600</text>") && !near.contains("leave"), "{near}");
    let far = sheet(12_000.0);
    assert!(far.contains(">300</text>") && far.contains("Rapids leave the picture: up to 12000 mm/min."), "{far}");
    assert_well_formed(&far);
}

#[test]
fn under_compensation_the_commanded_path_is_drawn_beside_the_contour() {
    let sheet = |contour: bool| {
        corner(4.0, 1, |drawing| {
            let way = cut([0.0, 0.0, 0.0], [100.0, 0.0, 0.0], 500.0);
            if contour { drawing.programmed(&way) } else { drawing.commanded(&way) }
        })
    };
    assert!(sheet(true).contains("programmed contour, and the commanded path beside it"));
    assert!(sheet(false).contains("programmed path"));
}

#[test]
fn nothing_is_a_chart_too() {
    let svg = chart(&[]).svg();
    assert_well_formed(&svg);
    assert!(svg.contains("Nothing takes time."), "{svg}");
    let mut strange = chart(&[('X', false)]);
    strange.begin(Kind::Rapid, [f64::NAN, f64::INFINITY]);
    strange.commanded([1.0, f64::NAN], f64::NAN);
    strange.moves(Kind::Rapid, 1.0, f64::INFINITY, &[f64::NAN]);
    strange.block(1, f64::INFINITY);
    assert_well_formed(&strange.svg());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn whatever_is_driven_is_a_picture(
        points in prop::collection::vec(prop::array::uniform3(-1e3..1e3f64), 2..20),
        scale in -9..9i32,
        off in prop::array::uniform3(-1.0..1.0f64),
        off_by in -8..3i32,
        times in 1.0..1e6f64,
        look in 0..3u8,
    ) {
        let mut drawing = Drawing::new(title());
        drawing.show(&[Layer::Programmed, Layer::Actual, Layer::Compensated]);
        drawing.look([Look::Both, Look::Plan, Look::Around([0.0, 0.0], 0.001)][usize::from(look)]);
        drawing.exaggerate(if times < 5e5 { 1.0 } else { times });
        let points: Vec<[f64; 3]> = points.iter().map(|at| at.map(|part| part * 10f64.powi(scale))).collect();
        for pair in points.windows(2) {
            let way = cut(pair[0], pair[1], 500.0);
            let beside = |part: f64| {
                let at = |axis: usize| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * part;
                std::array::from_fn(|axis| at(axis) + off[axis] * 10f64.powi(off_by))
            };
            drawing.stroke(&way);
            drawing.ordered(&way);
            drawing.commanded(&way);
            drawing.driven(Kind::Feed, &[beside(0.0), beside(0.3), beside(1.0)]);
        }
        let svg = drawing.svg();
        assert_well_formed(&svg);
        prop_assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", svg);
    }
}
