//! A plot with logarithmic axes, drawn with egui's painter.

use egui::{Align2, Color32, CornerRadius, FontId, Pos2, Rect, Sense, Stroke, TextStyle, Ui, pos2, vec2};
use gonio_language::tr;

/// A line of a plot.
pub struct Line {
    /// The name in the legend.
    pub name: &'static str,
    /// The colour.
    pub color: Color32,
    /// x and y; values that are not positive are left out.
    pub points: Vec<[f64; 2]>,
}

/// Lines over logarithmic axes.
pub struct Plot {
    /// Label of the x axis.
    pub x_label: &'static str,
    /// Label of the y axis.
    pub y_label: &'static str,
    /// The lines.
    pub lines: Vec<Line>,
}

/// A logarithmic axis. Both ends are powers of ten, so that it rarely changes while points are added.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    low: i32,
    high: i32,
}

impl Axis {
    /// The axis for these values; from 1 to 10 if there are none.
    fn around(values: impl Iterator<Item = f64>) -> Axis {
        let logs = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high {
            return Axis { low: 0, high: 1 };
        }
        let low = low.floor() as i32;
        Axis { low, high: (high.ceil() as i32).max(low + 1) }
    }

    /// Position of a value, from 0 at the low end to 1 at the high end.
    fn share(&self, value: f64) -> f32 {
        ((value.log10() - f64::from(self.low)) / f64::from(self.high - self.low)) as f32
    }

    /// The powers of ten, with their labels.
    fn ticks(&self) -> Vec<(f64, String)> {
        let written = |power: i32| match power {
            0..=3 => format!("{}", 10_i64.pow(power as u32)),
            4..=5 => format!("{} 000", 10_i64.pow(power as u32 - 3)),
            -3..=-1 => format!("{:.*}", power.unsigned_abs() as usize, 10_f64.powi(power)),
            _ => format!("1e{power}"),
        };
        (self.low..=self.high).map(|power| (10_f64.powi(power), written(power))).collect()
    }
}

impl Plot {
    /// Shows the plot over the whole width, with the values of the point nearest to the pointer.
    pub fn show(&self, ui: &mut Ui, name: &str) {
        let width = ui.available_width();
        let (room, response) = ui.allocate_exact_size(vec2(width, (0.62 * width).clamp(150.0, 320.0)), Sense::hover());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
        let all = || self.lines.iter().flat_map(|line| &line.points);
        let (x, y) = (Axis::around(all().map(|p| p[0])), Axis::around(all().map(|p| p[1])));
        let frame = Rect::from_min_max(room.min + vec2(40.0, 22.0), room.max - vec2(26.0, 34.0));
        let place = |p: &[f64; 2]| {
            pos2(frame.left() + x.share(p[0]) * frame.width(), frame.bottom() - y.share(p[1]) * frame.height())
        };
        let small = TextStyle::Small.resolve(ui.style());
        self.axes(ui, frame, (x, y), &small);
        let painter = ui.painter();
        for line in &self.lines {
            let known: Vec<Pos2> = line.points.iter().filter(|p| p[0] > 0.0 && p[1] > 0.0).map(place).collect();
            for dot in &known {
                painter.circle_filled(*dot, 2.5, line.color);
            }
            painter.line(known, Stroke::new(1.6, line.color));
        }
        self.legend(ui, frame, &small);
        if let Some(pointer) = response.hover_pos() {
            self.hovered(ui, pointer, place, frame, &small);
        }
    }

    fn axes(&self, ui: &Ui, frame: Rect, (x, y): (Axis, Axis), font: &FontId) {
        let painter = ui.painter();
        let (weak, line) = (ui.visuals().weak_text_color(), ui.visuals().widgets.noninteractive.bg_stroke);
        for (value, text) in x.ticks() {
            let at = frame.left() + x.share(value) * frame.width();
            painter.vline(at, frame.y_range(), line);
            painter.text(pos2(at, frame.bottom() + 4.0), Align2::CENTER_TOP, text, font.clone(), weak);
        }
        for (value, text) in y.ticks() {
            let at = frame.bottom() - y.share(value) * frame.height();
            painter.hline(frame.x_range(), at, line);
            painter.text(pos2(frame.left() - 5.0, at), Align2::RIGHT_CENTER, text, font.clone(), weak);
        }
        let below = pos2(frame.center().x, frame.bottom() + 18.0);
        painter.text(below, Align2::CENTER_TOP, self.x_label, font.clone(), weak);
        let above = pos2(frame.left() - 34.0, frame.top() - 6.0);
        painter.text(above, Align2::LEFT_BOTTOM, self.y_label, font.clone(), weak);
    }

    /// The legend at the bottom left, where falling curves leave room.
    fn legend(&self, ui: &Ui, frame: Rect, font: &FontId) {
        let lines = self.lines.len() as f32;
        let ground =
            Rect::from_min_size(frame.left_bottom() + vec2(6.0, -(16.0 * lines + 8.0)), vec2(72.0, 16.0 * lines + 2.0));
        ui.painter().rect_filled(ground, CornerRadius::same(4), ui.visuals().panel_fill.gamma_multiply(0.85));
        for (i, line) in self.lines.iter().enumerate() {
            let y = ground.top() + 9.0 + 16.0 * i as f32;
            let left = ground.left() + 6.0;
            ui.painter().hline(left..=left + 14.0, y, Stroke::new(2.0, line.color));
            let color = ui.visuals().text_color();
            ui.painter().text(pos2(left + 20.0, y), Align2::LEFT_CENTER, line.name, font.clone(), color);
        }
    }

    fn hovered(&self, ui: &Ui, pointer: Pos2, place: impl Fn(&[f64; 2]) -> Pos2, frame: Rect, font: &FontId) {
        let points = self.lines.iter().flat_map(|line| line.points.iter().map(move |p| (line, p)));
        let known = points.filter(|(_, p)| p[0] > 0.0 && p[1] > 0.0);
        let distance = |(_, p): &(&Line, &[f64; 2])| place(p).distance(pointer);
        let Some((line, point)) = known.min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return };
        let at = place(point);
        if at.distance(pointer) > 40.0 {
            return;
        }
        ui.painter().circle_stroke(at, 5.0, Stroke::new(1.5, line.color));
        let text = tr!(
            "scene-triangles-of-255",
            name = line.name,
            triangles = format!("{:.0}", point[0]),
            difference = format!("{:.3}", point[1])
        );
        let galley = ui.painter().layout_no_wrap(text, font.clone(), ui.visuals().strong_text_color());
        let size = galley.size() + vec2(12.0, 6.0);
        // Above the point, within the frame.
        let left = (at.x - 0.5 * size.x).clamp(frame.left(), (frame.right() - size.x).max(frame.left()));
        let top = if at.y - size.y - 10.0 > frame.top() { at.y - size.y - 10.0 } else { at.y + 10.0 };
        let ground = Rect::from_min_size(pos2(left, top), size);
        ui.painter().rect_filled(ground, CornerRadius::same(5), ui.visuals().widgets.hovered.bg_fill);
        ui.painter().galley(ground.min + vec2(6.0, 3.0), galley, ui.visuals().strong_text_color());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_reach_to_whole_powers_of_ten() {
        assert_eq!(Axis::around([8.0, 8192.0].into_iter()), Axis { low: 0, high: 4 });
        assert_eq!(Axis::around([0.05, 30.0, 0.0, f64::NAN].into_iter()), Axis { low: -2, high: 2 });
        assert_eq!(Axis::around([10.0].into_iter()), Axis { low: 1, high: 2 });
        assert_eq!(Axis::around([].into_iter()), Axis { low: 0, high: 1 });
    }

    #[test]
    fn values_lie_between_their_ticks() {
        let axis = Axis { low: -2, high: 2 };
        assert_eq!([0.01, 1.0, 100.0].map(|v| axis.share(v)), [0.0, 0.5, 1.0]);
        let ticks: Vec<String> = axis.ticks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(ticks, ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(Axis { low: 3, high: 6 }.ticks().pop().map(|(_, text)| text), Some("1e6".into()));
    }
}
