package lcm.spy;

import java.awt.Frame;
import java.awt.Rectangle;
import java.awt.Robot;
import java.io.File;
import javax.imageio.ImageIO;
import javax.swing.SwingUtilities;

/**
 * Runs lcm-spy as scripts/spy does, opens the plugins as a person would with a right-click, and after some seconds
 * prints a line per channel (name, class, messages, undecodable) and saves what is on the screen. It is in the
 * spy's package because only there its table can be read. usage: SpyProbe URL SECONDS PICTURE
 */
public class SpyProbe {
  public static void main(String[] args) {
    int code = 1;
    try {
      Spy spy = new Spy(args[0]);
      Thread.sleep(Long.parseLong(args[1]) * 1000);
      SwingUtilities.invokeAndWait(() -> openPlugins(spy));
      Thread.sleep(1500);
      ImageIO.write(new Robot().createScreenCapture(new Rectangle(1280, 1024)), "png", new File(args[2]));
      for (ChannelData channel : spy.channelList)
        System.out.printf("channel %s %s %d %d%n", channel.name, channel.cls == null ? "?" : channel.cls.getName(),
            channel.nreceived, channel.nerrors);
      code = 0;
    } catch (Exception error) {
      error.printStackTrace();
    }
    System.exit(code); // the spy's windows would keep it alive
  }

  private static void openPlugins(Spy spy) {
    for (SpyPlugin plugin : spy.plugins) {
      for (ChannelData channel : spy.channelList) {
        if (!plugin.canHandle(channel.fingerprint)) continue;
        System.out.println("plugin " + plugin.getClass().getName() + " for " + channel.name);
        spy.new PluginStarter(plugin, channel).getAction().actionPerformed(null);
      }
    }
    int down = 0;
    for (Frame frame : Frame.getFrames()) {
      if (!frame.isVisible()) continue;
      frame.setLocation(0, down);
      down += frame.getHeight();
    }
  }
}
