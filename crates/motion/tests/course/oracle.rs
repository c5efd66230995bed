//! The shortest time in which a path can be driven, found on a fine grid: bisection for the highest speed at every node
//! from which the rest can be kept to, then as fast as that allows. Shares nothing with the planner but the path.

use motion::{Limits, Way};

/// A part of a way, and the feed on it, mm/s of the axes together.
pub struct Piece {
    pub way: Way,
    pub part: [f64; 2],
    pub feed: f64,
}

/// A node: what the axes do for each mm of the way, the step behind it, the highest speed squared.
struct Node {
    slope: Vec<f64>,
    bend: Vec<f64>,
    step: f64,
    cap: f64,
    /// The node's own squared speed for each one of its step's end in the next node's measure.
    gain: f64,
}

/// Nodes of a whole path, and of a single piece at least.
const NODES: f64 = 40_000.0;
const LEAST: f64 = 40.0;
const HALVINGS: usize = 50;

/// The shortest time, s, from rest to rest.
pub fn optimum(limits: &Limits, pieces: &[Piece]) -> f64 {
    let nodes = grid(limits, pieces);
    let mut most = vec![0.0; nodes.len() + 1];
    for index in (0..nodes.len()).rev() {
        let node = &nodes[index];
        let end = most[index + 1] * node.gain;
        let (mut low, mut high) = (0.0, node.cap);
        if leads(limits, node, high, end) {
            low = high;
        }
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            if leads(limits, node, middle, end) { low = middle } else { high = middle }
        }
        most[index] = low;
    }
    let (mut x, mut seconds) = (0.0f64, 0.0);
    for (index, node) in nodes.iter().enumerate() {
        let [least, hardest] = range(limits, node, x);
        let end = (x + 2.0 * hardest.max(least) * node.step).min(most[index + 1] * node.gain).max(0.0);
        seconds += 2.0 * node.step / (x.sqrt() + end.sqrt());
        x = end / node.gain;
    }
    seconds
}

fn grid(limits: &Limits, pieces: &[Piece]) -> Vec<Node> {
    let whole: f64 = pieces.iter().map(|piece| piece.part[1] - piece.part[0]).sum();
    let pace = |piece: &Piece, s: f64| piece.way.slope(s)[..limits.count].iter().map(|part| part * part).sum::<f64>();
    let mut nodes = Vec::new();
    for (number, piece) in pieces.iter().enumerate() {
        let length = piece.part[1] - piece.part[0];
        let steps = (NODES * length / whole).ceil().max(LEAST);
        for index in 0..steps as usize {
            let s = piece.part[0] + length * index as f64 / steps;
            let (slope, bend) =
                (piece.way.slope(s)[..limits.count].to_vec(), piece.way.bend(s)[..limits.count].to_vec());
            let mut cap = piece.feed * piece.feed / pace(piece, s);
            for axis in 0..limits.count {
                let fastest = limits.axes[axis].max_feed / slope[axis].abs();
                cap = cap.min(fastest * fastest);
            }
            nodes.push(Node { slope, bend, step: length / steps, cap, gain: 1.0 });
        }
        if let (Some(next), Some(last)) = (pieces.get(number + 1), nodes.last_mut()) {
            last.gain = pace(next, next.part[0]) / pace(piece, piece.part[1]);
        }
    }
    nodes
}

/// The changes of speed that the axes can give at a squared speed.
fn range(limits: &Limits, node: &Node, x: f64) -> [f64; 2] {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..limits.count {
        let (given, slope, bent) = (limits.axes[axis].acceleration, node.slope[axis], node.bend[axis] * x);
        if slope.abs() < 1e-9 {
            if bent.abs() > given {
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
            continue;
        }
        let ends = [(-given - bent) / slope, (given - bent) / slope];
        low = low.max(ends[0].min(ends[1]));
        high = high.min(ends[0].max(ends[1]));
    }
    [low, high]
}

fn leads(limits: &Limits, node: &Node, x: f64, end: f64) -> bool {
    let [low, high] = range(limits, node, x);
    low <= high && x + 2.0 * low * node.step <= end
}
