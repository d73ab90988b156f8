package lcm.spy;

import java.awt.Component;
import java.awt.Frame;
import java.awt.image.BufferedImage;
import java.io.File;
import javax.imageio.ImageIO;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.SwingUtilities;

/**
 * Runs lcm-spy as scripts/spy does, opens the sonar ring as a person would with a right-click, and after some
 * seconds prints a line per channel (name, class, messages, undecodable) and saves what is on the screen. It is in
 * the spy's package because only there its table can be read. usage: SpyProbe URL SECONDS PICTURE
 */
public class SpyProbe {
  public static void main(String[] args) throws Exception {
    Spy spy = new Spy(args[0]);
    Thread.sleep(Long.parseLong(args[1]) * 1000);
    Frame frame = Frame.getFrames()[0];
    SwingUtilities.invokeAndWait(() -> openPlugins(spy, desktopOf(frame)));
    Thread.sleep(1500);
    SwingUtilities.invokeAndWait(() -> {
      BufferedImage picture = new BufferedImage(frame.getWidth(), frame.getHeight(), BufferedImage.TYPE_INT_RGB);
      frame.paint(picture.getGraphics());
      try {
        ImageIO.write(picture, "png", new File(args[2]));
      } catch (java.io.IOException error) {
        System.out.println("no picture: " + error);
      }
    });
    for (ChannelData channel : spy.channelList)
      System.out.printf("channel %s %s %d %d%n", channel.name, channel.cls == null ? "?" : channel.cls.getName(),
          channel.nreceived, channel.nerrors);
    System.exit(0);
  }

  private static JDesktopPane desktopOf(java.awt.Container container) {
    for (Component component : container.getComponents()) {
      if (component instanceof JDesktopPane) return (JDesktopPane) component;
      if (component instanceof java.awt.Container) {
        JDesktopPane found = desktopOf((java.awt.Container) component);
        if (found != null) return found;
      }
    }
    return null;
  }

  private static void openPlugins(Spy spy, JDesktopPane desktop) {
    for (SpyPlugin plugin : spy.plugins) {
      for (ChannelData channel : spy.channelList) {
        if (!plugin.canHandle(channel.fingerprint)) continue;
        System.out.println("plugin " + plugin.getClass().getName() + " for " + channel.name);
        plugin.getAction(desktop, channel).actionPerformed(null);
      }
    }
    int right = 0;
    for (JInternalFrame frame : desktop.getAllFrames()) {
      frame.setLocation(right, right / 3);
      right += 200;
    }
  }
}
