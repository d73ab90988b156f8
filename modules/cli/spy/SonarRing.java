package priamos.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.event.ActionEvent;
import java.awt.geom.AffineTransform;
import java.awt.geom.Arc2D;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Line2D;
import java.awt.geom.Rectangle2D;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.JPanel;
import javax.swing.Timer;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import priamos.sonar_ranges_t;

/**
 * Draws the ring of 24 sonars seen from above, forward up: right-click the channel in lcm-spy. Sensor 1 looks
 * straight ahead, then one every 15 degrees counter-clockwise (lcmtypes/README.md); an arc is the first echo, a
 * grey cone a sensor that heard none.
 */
public class SonarRing implements SpyPlugin {
  static final int SENSORS = 24;
  static final double LENGTH_M = 0.95, WIDTH_M = 0.78, RANGE_M = 5, CONE_DEG = 15;

  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == sonar_ranges_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Sonar ring") {
      @Override
      public void actionPerformed(ActionEvent event) {
        JInternalFrame frame = new JInternalFrame("Sonar ring: " + channel.name, true, true);
        View view = new View(channel);
        Timer timer = new Timer(100, tick -> view.repaint());
        timer.start();
        frame.addInternalFrameListener(
            new javax.swing.event.InternalFrameAdapter() {
              @Override
              public void internalFrameClosed(javax.swing.event.InternalFrameEvent closed) {
                timer.stop();
              }
            });
        frame.add(view);
        frame.pack();
        desktop.add(frame);
        frame.setVisible(true);
      }
    };
  }

  /** The drawing; metres become pixels so that the whole range fits. */
  static class View extends JPanel {
    private final ChannelData channel;

    View(ChannelData channel) {
      this.channel = channel;
      setPreferredSize(new Dimension(460, 320)); // fits into the window that lcm-spy gives a plugin
      setBackground(Color.WHITE);
    }

    @Override
    protected void paintComponent(Graphics graphics) {
      super.paintComponent(graphics);
      Graphics2D g = (Graphics2D) graphics.create();
      g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
      Object last = channel.last;
      double[] ranges = last instanceof sonar_ranges_t ? ((sonar_ranges_t) last).range_m : null;
      g.setColor(Color.DARK_GRAY);
      g.drawString(ranges == null ? "no message yet" : "circles: 1 m", 8, 16);
      double scale = Math.min(getWidth(), getHeight()) / (2 * (RANGE_M + LENGTH_M / 2));
      AffineTransform before = g.getTransform();
      g.translate(getWidth() / 2.0, getHeight() / 2.0);
      g.scale(scale, scale);
      g.setStroke(new BasicStroke((float) (1 / scale)));
      drawCircles(g);
      for (int i = 0; ranges != null && i < SENSORS; ++i) drawSensor(g, i, ranges[i], scale);
      g.setColor(new Color(0x335577));
      g.fill(new Rectangle2D.Double(-WIDTH_M / 2, -LENGTH_M / 2, WIDTH_M, LENGTH_M));
      g.setColor(Color.WHITE);
      g.draw(new Line2D.Double(0, 0, 0, -LENGTH_M / 2)); // forward
      g.setTransform(before);
      g.dispose();
    }

    private static void drawCircles(Graphics2D g) {
      g.setColor(new Color(0xdddddd));
      for (int r = 1; r <= RANGE_M; ++r) g.draw(new Ellipse2D.Double(-r, -r, 2 * r, 2 * r));
    }

    /** On the screen x is to the right and y down; the robot's forward is up and its left is left. */
    private static void drawSensor(Graphics2D g, int sensor, double range, double scale) {
      double angle = Math.toRadians(15.0 * sensor);
      double forward = Math.cos(angle), left = Math.sin(angle);
      double edge = Math.min(LENGTH_M / 2 / Math.max(Math.abs(forward), 1e-9),
          WIDTH_M / 2 / Math.max(Math.abs(left), 1e-9));
      double x = -left * edge, y = -forward * edge;
      double shown = range >= 0 ? range : RANGE_M;
      Arc2D cone = new Arc2D.Double(x - shown, y - shown, 2 * shown, 2 * shown,
          90 + 15.0 * sensor - CONE_DEG / 2, CONE_DEG, Arc2D.PIE);
      g.setColor(range >= 0 ? new Color(0x66, 0xaa, 0xdd, 0x80) : new Color(0xee, 0xee, 0xee, 0x80));
      g.fill(cone);
      if (range < 0) return;
      cone.setArcType(Arc2D.OPEN);
      g.setColor(new Color(0xcc3311));
      g.setStroke(new BasicStroke((float) (3 / scale)));
      g.draw(cone);
      g.setStroke(new BasicStroke((float) (1 / scale)));
    }
  }
}
